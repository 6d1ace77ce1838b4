// The program reaches every cell of the stated range, and says why where the smooth branch ends before.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "fem/observe.h"
#include "laboratory.h"
#include "solve/branch_ends.h"
#include "solve/resolved_branch.h"
#include "solve/stationary.h"
#include "solve/tube.h"

namespace rheocyte::range_test {
namespace {

using test::Inertia;
using test::LaboratoryCell;

constexpr double accuracy = 1e-4;

StationaryState solve(const LaboratoryCell& cell) {
  return solve_stationary(test::in_newtonian_liquid(cell, Inertia::none, accuracy));
}

struct NamedCell {
  std::string name;
  LaboratoryCell cell;
  double reached = 0;  ///< deformation that has to be reached
};

std::string name_of(const testing::TestParamInfo<NamedCell>& test) { return test.param.name; }

class Range : public testing::TestWithParam<NamedCell> {};

TEST_P(Range, IsReachedFromTheSphereInOneCall) {
  // The state converges to the wanted accuracy with the volume kept to 1e-6, and is as deformed as was asked for.
  const StationaryState state = solve(GetParam().cell);
  ASSERT_EQ(state.outcome.status, Status::converged) << state.outcome.message;
  EXPECT_GE(state.shape.deformation, GetParam().reached);
  EXPECT_LE(state.estimated_error, accuracy);
  EXPECT_LT(std::abs(state.relative_volume_change), 1e-6);  // wanted of the program
}

// r0/R = 0.1, 0.5, 0.88 with d = 0.01 or so; then d >= 0.1 where the branch goes so far.
INSTANTIATE_TEST_SUITE_P(Size, Range,
                         testing::Values(NamedCell{"small", {1.094, 0.7, BulkLaw::linear}, 0.005},
                                         NamedCell{"middle", {5.47, 4, BulkLaw::neo_hookean}, 0.005},
                                         NamedCell{"large", {9.6272, 8, BulkLaw::neo_hookean}, 0.005}),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Tenth, Range,
                         testing::Values(NamedCell{"linear_6um", {6, 1.58, BulkLaw::linear}, 0.1},
                                         NamedCell{"linear_8um", {7.66, 2.3, BulkLaw::linear}, 0.1},
                                         NamedCell{"linear_9um", {8.75, 3.0, BulkLaw::linear}, 0.1},
                                         NamedCell{"neo_hookean_9um", {8.75, 2.3, BulkLaw::neo_hookean}, 0.1}),
                         name_of);

class EndOfTheBranchSlow : public testing::TestWithParam<NamedCell> {};

/// The end of the branch by search, without what is known of it beforehand.
StationaryState search(const Problem& problem) {
  ResolvedBranch branch(problem, tube_geometry(problem));
  const ResolvedState end = branch.follow(Search::thorough);
  StationaryState state;
  end.discrete->describe(branch.problem_at(end.branch.parameter), end.branch.unknowns, state);
  state.outcome = {end.status, "", end.branch.parameter};
  return state;
}

TEST_P(EndOfTheBranchSlow, IsAnInstabilityOfTheSurface) {
  // Followed to a cell that is far too soft, the branch stops at Biot's limit, where it is known to end.
  const LaboratoryCell& cell = GetParam().cell;
  const Problem problem = test::in_newtonian_liquid(cell, Inertia::none, accuracy);
  const StationaryState state = search(problem);
  std::printf("| %g | %.3f | %.4f | %.2f | %.4f |\n", cell.radius_um, cell.young_modulus_kPa / state.outcome.reached,
              state.shape.deformation, state.shape.area * test::tube_radius_um * test::tube_radius_um,
              state.biot_ratio);
  EXPECT_NE(state.outcome.status, Status::converged);
  EXPECT_LT(state.stability_margin, small_margin);
  EXPECT_LT(state.outcome.reached, 1);
  EXPECT_GE(state.shape.deformation, GetParam().reached);
  // Newton loses the state a little above the limit, the more so the larger the cell.
  EXPECT_LT(state.biot_ratio, 1.1 * biot_limit);
  EXPECT_GT(state.biot_ratio, 0.9 * biot_limit);
  const double end = problem.bulk.shear_modulus / state.outcome.reached;
  EXPECT_NEAR(min_shear_modulus(problem).value(), end, 0.02 * end);
}

TEST_P(EndOfTheBranchSlow, IsSaidOfACellFarTooSoft) {
  // Asked for such a cell, the program says at once where the branch ends, and hands over a state before.
  const Problem problem = test::in_newtonian_liquid(GetParam().cell, Inertia::none, accuracy);
  const StationaryState state = solve_stationary(problem);
  EXPECT_EQ(state.outcome.status, Status::surface_unstable);
  EXPECT_NE(state.outcome.message.find("Biot"), std::string::npos) << state.outcome.message;
  const double kept = problem.bulk.shear_modulus / state.outcome.reached / min_shear_modulus(problem).value();
  EXPECT_GT(kept, 1);
  EXPECT_LT(kept, 1.3);
  EXPECT_GE(state.shape.deformation, GetParam().reached / 2);
}

INSTANTIATE_TEST_SUITE_P(Linear, EndOfTheBranchSlow,
                         testing::Values(NamedCell{"2um", {2, 0.25, BulkLaw::linear}, 0.11},
                                         NamedCell{"3um", {3.4, 0.42, BulkLaw::linear}, 0.11},
                                         NamedCell{"6um", {6, 0.74, BulkLaw::linear}, 0.16},
                                         NamedCell{"8um", {7.66, 1.23, BulkLaw::linear}, 0.19},
                                         NamedCell{"9um", {8.75, 1.4, BulkLaw::linear}, 0.18},
                                         NamedCell{"10um", {9.6, 1.54, BulkLaw::linear}, 0.18}),
                         name_of);
INSTANTIATE_TEST_SUITE_P(NeoHookean, EndOfTheBranchSlow,
                         testing::Values(NamedCell{"2um", {2, 0.25, BulkLaw::neo_hookean}, 0.08},
                                         NamedCell{"3um", {3.4, 0.42, BulkLaw::neo_hookean}, 0.08},
                                         NamedCell{"6um", {6, 0.74, BulkLaw::neo_hookean}, 0.08},
                                         NamedCell{"8um", {7.66, 1.23, BulkLaw::neo_hookean}, 0.09},
                                         NamedCell{"9um", {8.75, 1.4, BulkLaw::neo_hookean}, 0.1},
                                         NamedCell{"10um", {9.6, 1.54, BulkLaw::neo_hookean}, 0.1}),
                         name_of);

}  // namespace
}  // namespace rheocyte::range_test
