#include "sweep/sample_branch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "case/scales.h"
#include "solve/stationary.h"

namespace rheocyte::sample_branch_test {
namespace {

TableSpec spec(const std::string& cell, const std::string& table) {
  return parse_table_spec("[channel]\nradius_um = 10.94\n[flow]\nrate_ul_per_s = 0.04\nviscosity_mPas = 15.0\n" + cell +
                              "[table]\nidentifier = \"TEST\"\n" + table,
                          "test");
}

const std::string linear_solid = "[cell.bulk]\nlaw = \"linear\"\n";
const std::string shell = "[cell.bulk]\nlaw = \"none\"\n[cell.cortex]\nlaw = \"neo-hookean\"\ntension_ratio = 0.1\n";

StationaryState solved(const TableSpec& table, const SweepPoint& place, double stiffness, double accuracy) {
  Problem problem = problem_of(case_at(table, place, stiffness));
  problem.accuracy = accuracy;
  return solve_stationary(problem);
}

double solved_deformation(const TableSpec& table, double radius_um, double stiffness) {
  const StationaryState state = solved(table, {radius_um}, stiffness, 1e-5);
  EXPECT_EQ(state.outcome.status, Status::converged) << state.outcome.message;
  return state.shape.deformation;
}

/// Greatest relative difference of the deformation between samples from direct solves at the middles of the softest
/// intervals, where the branch bends most.
double max_difference(const TableSpec& table, const SampledBranch& branch) {
  double greatest = 0;
  for (int i = std::max(1, branch.samples() - 7); i < branch.samples(); ++i) {
    const double stiffness = std::sqrt(branch.stiffness[i - 1] * branch.stiffness[i]);
    const double d = interpolate(branch, Measure::deformation, stiffness);
    greatest = std::max(greatest, std::abs(d / solved_deformation(table, branch.radius_um, stiffness) - 1));
  }
  return greatest;
}

TEST(SampleBranch, BetweenItsSamplesTheDeformationIsThatOfDirectSolves) {
  // Within the wanted accuracy of 2e-4, for a solid to the end of its branch and for a shell.
  const TableSpec solid = spec(linear_solid, "radii = 3\n");
  const SampledBranch branch = sample_branch(solid, {6});
  EXPECT_EQ(branch.end.status, Status::surface_unstable);
  EXPECT_GT(branch.at(branch.samples() - 1, Measure::deformation), 0.16);
  EXPECT_LT(branch.at(0, Measure::deformation), solid.min_deformation);
  EXPECT_LT(max_difference(solid, branch), 2e-4);
  const TableSpec thin = spec(shell, "max_deformation = 0.03\n");
  const SampledBranch shells = sample_branch(thin, {7.66});
  EXPECT_EQ(shells.end.status, Status::covered);
  EXPECT_LT(max_difference(thin, shells), 2e-4);
}

TEST(SampleBranch, AnElongatedBranchIsThatOfDirectSolves) {
  // At constant ratio of the axial tension to the stiffness: from hardly deformed by the flow to a third mode of 0.06,
  // the modes between the samples are those of direct solves to 1e-3.
  const TableSpec table =
      spec("[cell.bulk]\nlaw = \"neo-hookean\"\n[cell.cortex]\nlaw = \"neo-hookean-reference\"\nbending_kBT = 3e4\n",
           "cortex_fraction = [0, 0.5]\ntension_ratio = [0.25]\naxial_ratio = [-0.1, 0, 0.2, 0.4]\naccuracy = 2e-3\n"
           "max_deformation = 0.012\nmax_deformation_raw = 0.015\nmin_deformation = 1e-3\n");
  const SweepPoint place{6.7, 0.5, 0.25, 0.4};
  const SampledBranch branch = sample_branch(table, place);
  EXPECT_EQ(branch.end.status, Status::covered) << branch.end.message;
  ASSERT_GT(branch.samples(), 4);
  const auto elongation = [&](int i) { return branch.at(i, Measure::named("mode_2")); };
  EXPECT_LT(branch.at(0, Measure::mode_3), 0.01);
  EXPECT_NEAR(elongation(branch.samples() - 1), elongation(0), 0.05) << "the tension goes with the stiffness";
  EXPECT_GT(elongation(0), 0.15);
  EXPECT_GT(branch.at(0, Measure::deformation_raw), 0.015) << "by the tension alone, which makes no dents";
  for (const int i : {branch.samples() / 2, branch.samples() - 1}) {
    const double S = std::sqrt(branch.stiffness[std::size_t(i) - 1] * branch.stiffness[std::size_t(i)]);
    const StationaryState state = solved(table, place, S, 1e-4);
    ASSERT_EQ(state.outcome.status, Status::converged) << state.outcome.message;
    for (int k = 2; k <= 5; ++k) {
      const double direct = state.shape.modes[std::size_t(k - first_radius_mode)];
      const Measure measure = k == 2   ? Measure::named("mode_2")
                              : k == 3 ? Measure::mode_3
                              : k == 4 ? Measure::named("mode_4")
                                       : Measure::named("mode_5");
      EXPECT_NEAR(interpolate(branch, measure, S), direct, 1e-3 * std::max(0.1, std::abs(direct))) << k;
    }
  }
}

TEST(SampleBranch, ADentedBranchIsThatOfDirectSolves) {
  // Cells with a cortex as soft as real ones: the mesh is fitted on the way, to d = 0.089, of which the tension makes
  // 0.049, and a dent at the rear.
  const TableSpec table =
      spec("[cell.bulk]\nlaw = \"neo-hookean\"\n[cell.cortex]\nlaw = \"neo-hookean\"\nbending_kBT = 1e4\n",
           "cortex_fraction = [0, 0.65]\ntension_ratio = [0.615]\naxial_ratio = [0, 0.3, 0.6, 0.86]\naccuracy = 1e-2\n"
           "max_deformation = 0.04\nmax_deformation_raw = 0.25\nmin_deformation = 1e-3\n");
  const SweepPoint place{6.5, 0.65, 0.615, 0.86};
  const SampledBranch branch = sample_branch(table, place);
  EXPECT_EQ(branch.end.status, Status::covered) << branch.end.message;
  const int last = branch.samples() - 1;
  EXPECT_GT(branch.at(last, Measure::deformation_raw), branch.at(last, Measure::deformation) + 0.02) << "a dent";
  const double S = std::sqrt(branch.stiffness[std::size_t(last) - 1] * branch.stiffness[std::size_t(last)]);
  const StationaryState state = solved(table, place, S, 3e-3);
  ASSERT_EQ(state.outcome.status, Status::converged) << state.outcome.message;
  EXPECT_NEAR(interpolate(branch, Measure::deformation, S) / state.shape.deformation, 1, 5e-3);
  EXPECT_NEAR(interpolate(branch, Measure::mode_3, S), state.shape.modes[3 - first_radius_mode], 1e-3);
}

TEST(SampleBranch, TheSlopesAreThoseOfTheSamples) {
  // d(value)/d(ln stiffness) by differences of neighbouring interpolations would be circular: compare with direct
  // solves.
  const TableSpec table = spec(linear_solid, "max_deformation = 0.02\n");
  const SampledBranch branch = sample_branch(table, {6});
  const int i = branch.samples() - 2;
  const double E = branch.stiffness[i], h = 0.01;
  const double difference =
      (solved_deformation(table, 6, E * std::exp(h)) - solved_deformation(table, 6, E * std::exp(-h))) / (2 * h);
  // Differences of 1e-2: error h^2/6 f''' of 1e-4, and 1e-5 / 1e-2 of the solves.
  EXPECT_NEAR(branch.slope(i, int(Measure::deformation)) / difference, 1, 2e-3);
}

TEST(SampleBranch, BeyondTheBareSurfaceBendingGoesOn) {
  // The held branch overlaps the bare one, agrees with it within the known effect of 1e4 k_B T, and goes farther.
  const TableSpec table = spec("[cell.bulk]\nlaw = \"neo-hookean\"\n", "bending_beyond_kBT = 1e4\n");
  const SampledBranch bare = sample_branch(table, {6});
  EXPECT_EQ(bare.end.status, Status::surface_unstable);
  const SampledBranch regularised = sample_regularised_branch(table, {6}, bare);
  ASSERT_FALSE(regularised.empty()) << regularised.end.message;
  EXPECT_EQ(regularised.bending_kBT, 1e4);
  EXPECT_GT(regularised.stiffness.front(), bare.stiffness.back());
  EXPECT_LT(regularised.stiffness.back(), bare.stiffness.back());
  EXPECT_GT(regularised.at(regularised.samples() - 1, Measure::deformation), 0.1);
  const double d = interpolate(bare, Measure::deformation, regularised.stiffness.front());
  EXPECT_NEAR(regularised.at(0, Measure::deformation) / d, 1, 0.01);  // docs/verification.md, sec. 6
}

TEST(SampleBranch, NothingIsHeldWhereNothingIsUnstable) {
  // A branch that leaves the table's range, and a spec that asks for no bending.
  const TableSpec covered = spec(linear_solid, "max_deformation = 0.01\nbending_beyond_kBT = 1e4\n");
  EXPECT_TRUE(sample_regularised_branch(covered, {6}, sample_branch(covered, {6})).empty());
}

TEST(SampleBranch, TheSameBranchHasTheSameBits) {
  // Two runs, the time that they took apart.
  const TableSpec table = spec(linear_solid, "max_deformation = 0.01\n");
  SampledBranch one = sample_branch(table, {4}), other = sample_branch(table, {4});
  for (SampledBranch* branch : {&one, &other}) branch->seconds = branch->factorisation_seconds = 0;
  EXPECT_EQ(to_bytes(one, "x"), to_bytes(other, "x"));
}

TEST(SampleBranch, AStopEndsItAndSaysSo) {
  // Before the first state already.
  const std::atomic<bool> stop = true;
  const SampledBranch branch = sample_branch(spec(linear_solid, ""), {6}, &stop);
  EXPECT_EQ(branch.end.status, Status::stopped);
  EXPECT_TRUE(branch.empty());
}

}  // namespace
}  // namespace rheocyte::sample_branch_test
