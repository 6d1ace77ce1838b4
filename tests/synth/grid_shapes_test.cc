// Cells drawn from a grid are those that the grid knows: its modulus, the volume of their sphere, and named ends.
#include "synth/grid_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "shape/outline_shape.h"
#include "table/stiffness_grid.h"

namespace rheocyte::grid_shapes_test {
namespace {

GridContent shipped(const std::string& name) {
  std::ifstream file(SHIPPED_TABLES "/grid_" + name + ".cbor", std::ios::binary);
  return grid_from_bytes(std::string(std::istreambuf_iterator<char>(file), {}), name);
}

constexpr double viscosity_mPas = 15;

class GridShapesOf : public testing::TestWithParam<const char*> {
 protected:
  GridShapes shapes_{shipped(GetParam()), {20, 0.04}};
  StiffnessGrid grid_{shipped(GetParam())};
};

TEST_P(GridShapesOf, ItsModulusIsThatOfTheGridAndItsVolumeThatOfTheSphere) {
  const ShapeGrid shapes(grid_.content().shapes.value());
  const double from_grid = scale_factors(grid_.origin().flow, {20, 0.04, viscosity_mPas}).modulus;
  // The last is deformed by 0.1 (LE-2D-26) or 0.045 (HE-3D-26).
  const double softest = grid_.origin().section == Section::tube ? 2.5 : 5.5;
  for (const auto& [radius, modulus] :
       std::vector<std::pair<double, double>>{{5, 2.5}, {6, 3}, {7, 6}, {7.5, softest}}) {
    const auto found = shapes_.shape({.radius_um = radius, .stiffness = modulus, .viscosity_mPas = viscosity_mPas});
    ASSERT_TRUE(std::holds_alternative<CellShape>(found)) << radius << " " << modulus;
    const auto& cell = std::get<CellShape>(found);
    const GridAnswer answer = grid_.answer(cell.area_um2, cell.deformation);
    EXPECT_NEAR(std::exp(answer.log_stiffness) * from_grid, modulus, 1e-6 * modulus);
    EXPECT_NEAR(cell.volume_um3, 4 * M_PI / 3 * radius * radius * radius, 1e-6 * cell.volume_um3);
    const OutlineShape outline = outline_shape(mirrored(cell.meridian));
    EXPECT_NEAR(outline.area, cell.area_um2, 1e-4 * cell.area_um2) << "that of the hull";
    // The grid's modes stop at c_7; what they lack of the deformation is made up for.
    EXPECT_NEAR(outline.deformation, cell.deformation, 2e-4 * cell.deformation);
    const auto modes = shapes.modes(std::log(cell.area_um2), cell.deformation);
    for (std::size_t k = 0; k < std::tuple_size_v<RadiusModes>; ++k) EXPECT_NEAR(outline.modes[k], modes[k], 5e-4) << k;
  }
}

TEST_P(GridShapesOf, WhatItDoesNotKnowHasAName) {
  const auto reason = [&](double radius, double modulus) {
    const auto found = shapes_.shape({.radius_um = radius, .stiffness = modulus, .viscosity_mPas = viscosity_mPas});
    return std::get<NoShape>(found);
  };
  EXPECT_EQ(reason(2, 3), NoShape::too_small);
  EXPECT_EQ(reason(9.5, 3), NoShape::too_large);
  EXPECT_EQ(reason(6, 1e5), NoShape::too_stiff);
  EXPECT_EQ(reason(6, 0.1), NoShape::too_soft);
  EXPECT_EQ(reason(6, -1), NoShape::too_soft);
}

TEST_P(GridShapesOf, AnotherChannelScalesTheCell) {
  const GridShapes wide(shipped(GetParam()), {30, 0.16});
  const auto here = shapes_.shape({.radius_um = 6, .stiffness = 3, .viscosity_mPas = viscosity_mPas});
  const double modulus = 3 * (0.16 / 0.04) * std::pow(20. / 30, 3);
  const auto there = wide.shape({.radius_um = 9, .stiffness = modulus, .viscosity_mPas = viscosity_mPas});
  EXPECT_NEAR(std::get<CellShape>(there).deformation, std::get<CellShape>(here).deformation, 1e-6);
  EXPECT_NEAR(std::get<CellShape>(there).area_um2, 2.25 * std::get<CellShape>(here).area_um2, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Tables, GridShapesOf, testing::Values("HE-3D-26", "LE-2D-26"));

}  // namespace
}  // namespace rheocyte::grid_shapes_test
