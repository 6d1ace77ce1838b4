// Virtual cells under an axial tension are those of the table of elongated ones, and their outlines have its modes.
#include "synth/elongated_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "infer/elongated_solids.h"
#include "laws/uniaxial.h"
#include "shape/outline_shape.h"

namespace rheocyte::elongated_shapes_test {
namespace {

ElongatedContent shipped() {
  std::ifstream file(SHIPPED_TABLES "/elongated_HE-3D-el-26.cbor", std::ios::binary);
  return elongated_from_bytes(std::string(std::istreambuf_iterator<char>(file), {}), "HE-3D-el-26");
}

VirtualCell cell(double radius_um, double modulus_kPa, double tension_Pa) {
  VirtualCell cell{.radius_um = radius_um, .stiffness = modulus_kPa, .viscosity_mPas = 15};
  cell.axial_tension_Pa = tension_Pa;
  return cell;
}

class ElongatedShapesOf : public testing::Test {
 protected:
  ElongatedCellShapes shapes_{shipped(), {20, 0.04}};
  ElongatedSolids solids_{shipped()};
};

TEST_F(ElongatedShapesOf, AreaAndModesOfTheOutlineGiveRadiusModulusAndTensionBack) {
  for (const auto& [radius, modulus, tension] :
       std::vector<std::array<double, 3>>{{5, 3, 0}, {6, 4, 600}, {7, 8, 2000}, {6, 6, -300}}) {
    const auto found = shapes_.shape(cell(radius, modulus, tension));
    ASSERT_TRUE(std::holds_alternative<CellShape>(found)) << radius;
    const auto& shape = std::get<CellShape>(found);
    const OutlineShape outline = outline_shape(mirrored(shape.meridian));
    EXPECT_NEAR(outline.area, shape.area_um2, 1e-3 * shape.area_um2);
    const auto back = solids_.find({std::log(outline.area), outline.modes[0], outline.modes[1]}, ElongatedBy::modes);
    ASSERT_EQ(back.reason, ModulusState::valid);
    // The table's liquid has 15 mPa s, too, so that nothing is scaled.
    EXPECT_NEAR(std::exp(back.state.log_modulus), modulus, 0.02 * modulus);
    EXPECT_NEAR(back.cell(1) * modulus * 1e3, tension, 20 + 0.02 * std::abs(tension));
    EXPECT_NEAR(back.state.radius_um, radius, 1e-2 * radius);
  }
}

TEST_F(ElongatedShapesOf, AnotherChannelScalesTheTensionAsTheModulus) {
  const ElongatedCellShapes wide(shipped(), {30, 0.16});
  const double factor = (0.16 / 0.04) * std::pow(20. / 30, 3);
  const auto here = shapes_.shape(cell(6, 4, 600)), there = wide.shape(cell(9, 4 * factor, 600 * factor));
  EXPECT_NEAR(std::get<CellShape>(there).deformation, std::get<CellShape>(here).deformation, 1e-12);
  EXPECT_NEAR(std::get<CellShape>(there).area_um2, 2.25 * std::get<CellShape>(here).area_um2, 1e-9);
}

TEST_F(ElongatedShapesOf, CellsThatAreLongAtRestAreFoundByTheirAspect) {
  // The table's ratio is the tension that would draw a sphere out to this aspect where nothing flows.
  ElongatedContent content = shipped();
  content.elongation = Elongation::by_rest_shape;
  const ElongatedCellShapes at_rest(content, {20, 0.04});
  VirtualCell long_cell = cell(6, 4, 0);
  long_cell.rest_aspect = aspect_by_tension(0.15);
  const auto found = at_rest.shape(long_cell), by_tension = shapes_.shape(cell(6, 4, 600));
  EXPECT_NEAR(std::get<CellShape>(found).deformation, std::get<CellShape>(by_tension).deformation, 1e-12);
  long_cell.rest_aspect = 3;
  EXPECT_EQ(std::get<NoShape>(at_rest.shape(long_cell)), NoShape::outside_aspects);
}

TEST_F(ElongatedShapesOf, WhatTheTableLacksHasAName) {
  const auto reason = [&](double radius, double modulus, double tension) {
    return std::get<NoShape>(shapes_.shape(cell(radius, modulus, tension)));
  };
  EXPECT_EQ(reason(1, 3, 0), NoShape::too_small);
  EXPECT_EQ(reason(9.9, 3, 0), NoShape::too_large);
  EXPECT_EQ(reason(6, 1e6, 0), NoShape::too_stiff);
  EXPECT_EQ(reason(6, 0.05, 0), NoShape::too_soft);
  EXPECT_EQ(reason(6, 4, 4000), NoShape::outside_tensions);
  EXPECT_EQ(reason(6, 0, 0), NoShape::too_soft);
}

}  // namespace
}  // namespace rheocyte::elongated_shapes_test
