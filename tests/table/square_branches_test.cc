#include "table/square_branches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../refusal.h"
#include "invented_branch.h"
#include "table/branch_curve.h"
#include "table/grid_from_branches.h"

namespace rheocyte::square_branches_test {
namespace {

const std::string channel = "width_um = 20.0\n[flow]\nrate_ul_per_s = 0.04\nviscosity_mPas = 15.0\n[table]\n";

TableSpec square_spec(const std::string& more = "radii = 20\n") {
  return parse_table_spec("[channel]\nsection = \"square\"\n" + channel +
                              "identifier = \"SQUARE\"\nmin_area_um2 = 40\nmax_area_um2 = 200\n"
                              "max_deformation = 0.15\nmin_deformation = 1e-4\n" +
                              more,
                          "test");
}

/// Cells of the square deform more than those of the tube by a fraction that grows with their size and falls with d.
double ratio(double radius, double deformation) {
  return 1 + 0.1 * std::pow(radius / 10, 3) * (1 - 0.5 * std::sqrt(deformation));
}

/// Of the invented tube, at moduli that are `ratio` times as great. The last state of one of the branches lies at a
/// `fraction` of the others' sqrt(d).
std::vector<SampledBranch> computed_branches(const TableSpec& spec, const std::vector<double>& radii_um,
                                             double fraction_of_one = 1) {
  std::vector<SampledBranch> branches;
  for (const double radius : radii_um) {
    auto sweep = test::covering(spec, radius, *spec.computed_states);
    SampledBranch branch = test::invented_branch(radius, sweep);
    // The states are those of points of Chebyshev's polynomials in sqrt(d).
    for (int k = 0; k < branch.samples(); ++k) {
      const double fraction = branches.size() == 3 ? fraction_of_one : 1;
      const double height = fraction * (0.525 - 0.475 * std::cos(std::numbers::pi * k / (branch.samples() - 1)));
      const double d = height * height * spec.max_deformation, E = test::invented_stiffness(radius, d);
      const auto state = test::invented_state(radius, E);
      branch.value.row(k) = state.col(0).transpose();
      branch.contour[std::size_t(k)] = test::invented_contour(radius, d);
      branch.stiffness[std::size_t(k)] = E * ratio(radius, d);
      branch.error[std::size_t(k)] = 1e-4;
    }
    set_slopes(branch, roots_of_deformation(branch));
    branches.push_back(std::move(branch));
  }
  return branches;
}

std::vector<SampledBranch> computed_branches(const TableSpec& spec, double fraction_of_one = 1) {
  return computed_branches(spec, computed_radii_um(spec), fraction_of_one);
}

GridContent tube_grid() {
  const TableSpec spec =
      parse_table_spec("[channel]\n" + channel + "identifier = \"TUBE\"\nradii = 40\nmax_deformation = 0.19\n", "test");
  return *make_stiffness_grid(spec, test::invented_branches(spec), "0");
}

/// Greatest relative difference of the modulus of the branches from the invented one at some deformations.
double max_difference(const std::vector<SampledBranch>& branches) {
  double greatest = 0;
  for (const SampledBranch& branch : branches)
    for (const double d : {2e-4, 1e-3, 1e-2, 0.05, 0.1, 0.14}) {
      const double wanted = test::invented_stiffness(branch.radius_um, d) * ratio(branch.radius_um, d);
      const double found = stiffness_at(branch, Measure::deformation, d);
      greatest = std::max(greatest, std::abs(found / wanted - 1));
    }
  return greatest;
}

TEST(SquareBranches, BetweenTheComputedStatesModuliAreThoseOfTheCell) {
  // Eight radii and six states: 4e-4 by themselves, 1e-4 by the ratio to the tube, which has less to interpolate.
  const TableSpec spec = square_spec();
  const auto computed = computed_branches(spec);
  EXPECT_LT(max_difference(square_branches(spec, computed, nullptr)), 1e-3);
  const GridContent tube = tube_grid();
  EXPECT_LT(max_difference(square_branches(spec, computed, &tube)), 1e-4);
}

TEST(SquareBranches, NoneLiesBeyondTheLastRadiusThatHasStates) {
  const TableSpec spec = square_spec();
  auto computed = computed_branches(spec);
  const double last_um = computed[computed.size() - 2].radius_um;
  SampledBranch without_states;
  without_states.radius_um = computed.back().radius_um;
  computed.back() = without_states;
  const auto branches = square_branches(spec, computed, nullptr);
  ASSERT_FALSE(branches.empty());
  EXPECT_LE(branches.back().radius_um, last_um);
  EXPECT_GT(branches.back().radius_um, 0.9 * last_um);
}

TEST(SquareBranches, TheErrorIsThatOfTheStatesNearby) {
  const TableSpec spec = square_spec();
  auto computed = computed_branches(spec);
  for (auto& branch : computed) branch.error.front() = 0.01;
  for (const auto& branch : square_branches(spec, computed, nullptr)) {
    EXPECT_GT(branch.error.front(), 0.009);
    EXPECT_LT(branch.error.back(), 0.002);
  }
}

TEST(SquareBranches, ComputedRadiiAreDenserAtBothEndsAndTowardsTheWall) {
  const auto radii = computed_radii_um(square_spec("computed_radii = 10\n"));
  ASSERT_EQ(radii.size(), 10u);
  EXPECT_NEAR(radii.back(), std::sqrt(200 / std::numbers::pi), 1e-12);
  EXPECT_LT(radii[1] - radii[0], radii[2] - radii[1]);
  EXPECT_LT(radii[9] - radii[8], 0.5 * (radii[1] - radii[0]));
  for (std::size_t i = 1; i < radii.size(); ++i) EXPECT_GT(radii[i], radii[i - 1]);
}

TEST(SquareBranches, ABranchWhoseLastStateLiesElsewhereDoesNotSpoilItsNeighbours) {
  const TableSpec spec = square_spec("radii = 20\ncomputed_radii = 12\ncomputed_states = 10\n");
  const double equal_ends = max_difference(square_branches(spec, computed_branches(spec), nullptr));
  for (const double fraction : {0.97, 1.03})
    EXPECT_LT(max_difference(square_branches(spec, computed_branches(spec, fraction), nullptr)), 3 * equal_ends);
}

TEST(SquareBranches, AtTheComputedStatesTheyAreThese) {
  const TableSpec spec = square_spec("computed_radii = 5\nradii = 3\n");
  auto radii_um = computed_radii_um(spec);
  radii_um[2] = sweep_radii_um(spec)[1];
  const auto computed = computed_branches(spec, radii_um);
  const GridContent tube = tube_grid();
  const auto branches = square_branches(spec, computed, &tube);
  for (const auto& [radius, place] : {std::pair(0, 0), {2, 1}, {4, 2}}) {
    const SampledBranch& own = computed[std::size_t(radius)];
    const double E = own.stiffness[3];
    // Cubics between dense samples.
    EXPECT_NEAR(interpolate(branches[std::size_t(place)], Measure::deformation, E) / own.at(3, Measure::deformation), 1,
                1e-6);
    EXPECT_NEAR(interpolate(branches[std::size_t(place)], Measure::area_um2, E) / own.at(3, Measure::area_um2), 1,
                1e-8);
    EXPECT_LT((interpolate_contour(branches[std::size_t(place)], E) - own.contour[3]).cwiseAbs().maxCoeff(), 1e-5);
  }
}

TEST(SquareBranches, TheStatedErrorHoldsThatOfTheComputedStatesAndOfThePolynomials) {
  const TableSpec spec = square_spec();
  const auto computed = computed_branches(spec);
  const LeftOut miss = left_out(spec, computed, nullptr);
  EXPECT_GT(miss.radius, 0);
  EXPECT_GT(miss.state, 0);
  const auto branches = square_branches(spec, computed, nullptr);
  EXPECT_GT(branches[3].error[10], 1e-4);
  EXPECT_LT(branches[3].error[10], 1e-4 + miss.radius + miss.state);
  const GridContent tube = tube_grid();
  EXPECT_LT(left_out(spec, computed, &tube).state, miss.state);
}

TEST(SquareBranches, BetweenBranchesThatBendingHoldsAllAreHeld) {
  const TableSpec spec = square_spec();
  auto computed = computed_branches(spec);
  for (SampledBranch& branch : computed) branch.bending_kBT = 100 * branch.radius_um;
  for (const SampledBranch& branch : square_branches(spec, computed, nullptr)) EXPECT_GT(branch.bending_kBT, 0);
  EXPECT_TRUE(can_lie_between(computed));
  EXPECT_FALSE(can_lie_between(std::span(computed).first(3)));
}

TEST(SquareBranches, TheTubesTableMustBeThatOfTheLiquid) {
  const TableSpec spec = square_spec();
  GridContent tube = tube_grid();
  tube.origin.flow.exponent = 0.6;
  const auto computed = computed_branches(spec);
  EXPECT_NE(test::refusal_of([&] { square_branches(spec, computed, &tube); }).find("table.tube_table"),
            std::string::npos);
}

TEST(SquareBranches, RectanglesAndOtherAnglesOfTheCameraHaveNoTables) {
  const auto refused = [](const std::string& head) {
    return test::refusal_of([&] { parse_table_spec("[channel]\n" + head + channel + "identifier = \"A\"\n", "test"); });
  };
  EXPECT_NE(refused("section = \"rectangle\"\nheight_um = 30.0\n").find("channel.section"), std::string::npos);
  EXPECT_NE(refused("section = \"square\"\ncamera_degree = 20.0\n").find("channel.camera_degree"), std::string::npos);
}

}  // namespace
}  // namespace rheocyte::square_branches_test
