// Between the radii and samples of branches lie the shapes of the model from which the branches were sampled.
#include "synth/branch_shapes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "synth/analytic_branches.h"
#include "synth/analytic_shapes.h"

namespace rheocyte::branch_shapes_test {
namespace {

constexpr double viscosity = 15;

std::vector<SampledBranch> analytic_branches() {
  std::vector<SampledBranch> branches;
  for (double radius = 4; radius < 8.2; radius += 0.25) branches.push_back(test::analytic_branch(radius));
  return branches;
}

constexpr SimulatedCells same{{20, 0.04, viscosity}, {20, 0.04}, false};

TEST(BranchShapes, LieBetweenTheBranches) {
  const auto branches = analytic_branches();
  const BranchShapes shapes(branches, same);
  const AnalyticShapes model({.flow = {20, 0.04}, .max_deformation = 0.1});
  for (const double radius : {4.0, 4.1, 5.6, 6.37, 7.9})
    for (const double stiffness : {4.1, 7.3, 19.0}) {
      const auto found = shapes.shape({radius, stiffness, viscosity});
      ASSERT_TRUE(std::holds_alternative<CellShape>(found)) << radius << " " << stiffness;
      const auto& shape = std::get<CellShape>(found);
      const auto expected = std::get<CellShape>(model.shape({radius, stiffness, viscosity}));
      // Cubics over steps of 4 % in the radius and 11 % in the stiffness.
      EXPECT_NEAR(shape.deformation, expected.deformation, 1e-3 * expected.deformation);
      EXPECT_NEAR(shape.area_um2, expected.area_um2, 1e-4 * expected.area_um2);
      EXPECT_NEAR(shape.volume_um3, expected.volume_um3, 1e-4 * expected.volume_um3);
      EXPECT_LT((shape.meridian - expected.meridian).cwiseAbs().maxCoeff(), 1e-4 * radius);
    }
}

TEST(BranchShapes, ScaleToOtherChannelsFlowsAndLiquids) {
  const auto branches = analytic_branches();
  SimulatedCells wide = same;
  wide.flow.width_um = 30;
  wide.flow.rate_ul_s = 0.16;
  const auto in_20 = std::get<CellShape>(BranchShapes(branches, same).shape({6, 8, viscosity}));
  const double stiffness = 8 * (0.16 / 0.04) * (5 / viscosity) * (8. / 27);
  const auto in_30 = std::get<CellShape>(BranchShapes(branches, wide).shape({9, stiffness, 5}));
  EXPECT_NEAR(in_30.deformation, in_20.deformation, 1e-12);
  EXPECT_NEAR(in_30.area_um2, 2.25 * in_20.area_um2, 1e-9);
  EXPECT_NEAR(in_30.volume_um3, 3.375 * in_20.volume_um3, 1e-9);
  wide.is_shell = true;
  const auto shell = std::get<CellShape>(BranchShapes(branches, wide).shape({9, stiffness * 1.5, 5}));
  EXPECT_NEAR(shell.deformation, in_20.deformation, 1e-12) << "moduli of surfaces scale with the square of the width";
}

TEST(BranchShapes, SayWhyThereIsNoShape) {
  const auto branches = analytic_branches();
  const BranchShapes shapes(branches, same);
  const auto reason = [&](double radius, double stiffness) {
    return std::get<NoShape>(shapes.shape({radius, stiffness, viscosity}));
  };
  EXPECT_EQ(reason(3.9, 8), NoShape::too_small);
  EXPECT_EQ(reason(NAN, 8), NoShape::too_small);
  EXPECT_EQ(reason(8.3, 8), NoShape::too_large);
  EXPECT_EQ(reason(6, 45), NoShape::too_stiff);
  EXPECT_EQ(reason(6, 3), NoShape::too_soft);
}

}  // namespace
}  // namespace rheocyte::branch_shapes_test
