// The analytical model gives the shapes of `rheocyte analytic`, in um, and says where it ends.
#include "synth/analytic_shapes.h"

#include <gtest/gtest.h>

#include <numbers>

#include "case/scales.h"

namespace rheocyte::analytic_shapes_test {
namespace {

constexpr AnalyticPopulation solids{.flow = {20, 0.04}};

CellShape shape_of(const AnalyticShapes& shapes, const VirtualCell& cell) {
  auto found = shapes.shape(cell);
  EXPECT_TRUE(std::holds_alternative<CellShape>(found)) << found.index();
  return std::holds_alternative<CellShape>(found) ? std::get<CellShape>(found) : CellShape{};
}

NoShape reason_of(const AnalyticShapes& shapes, const VirtualCell& cell) {
  const auto found = shapes.shape(cell);
  EXPECT_TRUE(std::holds_alternative<NoShape>(found));
  return std::get<NoShape>(found);
}

TEST(AnalyticShapes, ASolidIsThatOfTheDimensionlessModel) {
  const AnalyticShapes shapes(solids);
  const auto shape = shape_of(shapes, {6, 3, 15});
  const double R = 0.547 * 20;
  // eta Q / (R^3 E) with 15 mPa s x 0.04 ul/s = 6e-13 Pa m^3.
  const double capillary = 6e-13 / (R * R * R * 1e-18) / 3e3;
  const auto expected = small_deformation(solid_in_tube(6 / R), solid_strain(capillary));
  EXPECT_NEAR(shape.deformation, expected.shape.deformation, 1e-12);
  EXPECT_NEAR(shape.area_um2, expected.shape.area * R * R, 1e-9);
  // Incompressible to first order in a strain of some 0.1.
  EXPECT_NEAR(shape.volume_um3 / (4 * std::numbers::pi / 3 * 216), 1, 0.02);
  EXPECT_EQ(shape.meridian(0, 1), 0);
  EXPECT_GT(shape.meridian(0, 0), 0) << "from the front";
}

TEST(AnalyticShapes, AShellIsThatOfTheDimensionlessModel) {
  auto shells = solids;
  shells.is_shell = true;
  shells.tension_ratio = 0.1;
  shells.max_deformation = 0.01;
  const auto shape = shape_of(AnalyticShapes(shells), {6, 30, 15});
  const double R = 0.547 * 20;
  const double capillary = 6e-13 / (R * R * 1e-12) / 30e-3;
  const auto expected = small_deformation(shell_in_tube(6 / R, 0.1), shell_strain(capillary, 6 / R));
  EXPECT_NEAR(shape.deformation, expected.shape.deformation, 1e-12);
}

TEST(AnalyticShapes, SaysWhyThereIsNoShape) {
  const AnalyticShapes shapes(solids);
  EXPECT_EQ(reason_of(shapes, {0.5, 3, 15}), NoShape::too_small);
  EXPECT_EQ(reason_of(shapes, {-1, 3, 15}), NoShape::too_small);
  EXPECT_EQ(reason_of(shapes, {9, 3, 15}), NoShape::too_large);
  EXPECT_EQ(reason_of(shapes, {6, 0.5, 15}), NoShape::too_soft);
  EXPECT_EQ(reason_of(shapes, {6, 1e-5, 15}), NoShape::too_soft);
  EXPECT_EQ(reason_of(shapes, {6, -1, 15}), NoShape::too_soft);
}

TEST(AnalyticShapes, ScalesWithTheChannel) {
  auto wide = solids;
  wide.flow.width_um = 30;
  wide.flow.rate_ul_s = 0.16;
  const auto in_20 = shape_of(AnalyticShapes(solids), {6, 3, 15});
  const double same_load = 0.04 / 0.16 * 27. / 8;
  const auto in_30 = shape_of(AnalyticShapes(wide), {9, 3, 15 * same_load});
  EXPECT_NEAR(in_30.deformation, in_20.deformation, 1e-12);
  EXPECT_NEAR(in_30.area_um2, 2.25 * in_20.area_um2, 1e-9);
}

}  // namespace
}  // namespace rheocyte::analytic_shapes_test
