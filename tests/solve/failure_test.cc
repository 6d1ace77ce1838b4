// Every failure has its name, keeps the last good state, and says a sentence; none is a success.
#include <gtest/gtest.h>

#include <cmath>

#include "cases.h"
#include "solve/stationary.h"

namespace rheocyte::failure_test {
namespace {

TEST(Failure, ANumberThatIsNotFiniteIsNamed) {
  // NaN in the modulus or in the Reynolds number, infinity in the modulus.
  Problem bad_modulus = test::problem({}), bad_reynolds = bad_modulus, infinite = bad_modulus;
  bad_modulus.bulk.shear_modulus = std::nan("");
  bad_reynolds.liquid.reynolds = std::nan("");
  infinite.bulk.shear_modulus = INFINITY;
  for (const Problem& problem : {bad_modulus, bad_reynolds, infinite}) {
    const StationaryState state = solve_stationary(problem);
    EXPECT_EQ(state.outcome.status, Status::not_finite) << name(state.outcome.status);
    EXPECT_FALSE(state.outcome.message.empty());
    EXPECT_EQ(state.outcome.reached, 0);
  }
}

TEST(Failure, AStopBeforeTheFirstStateIsNamed) {
  // A flag that is up from the beginning: nothing is computed, nothing is blamed on the program.
  const std::atomic<bool> stop = true;
  const StationaryState state = solve_stationary(test::problem({}), {}, &stop);
  EXPECT_EQ(state.outcome.status, Status::stopped);
  EXPECT_EQ(state.outcome.message.find("fault"), std::string::npos) << state.outcome.message;
}

TEST(Failure, AStopOnTheWayKeepsTheLastState) {
  // The flag goes up after the first point of the branch.
  std::atomic<bool> stop = false;
  const StationaryState state = solve_stationary(
      test::problem({6, 2.29, 0}), [&](const BranchStep&) { stop = true; }, &stop);
  EXPECT_EQ(state.outcome.status, Status::stopped);
  EXPECT_GT(state.outcome.reached, 0);
  EXPECT_LT(state.outcome.reached, 1);
  EXPECT_GT(state.shape.deformation, 0);
  EXPECT_FALSE(state.contour.pieces.empty());
}

TEST(Failure, AStopOnTheLadderOfAccuracyKeepsTheWantedState) {
  // The flag goes up when the wanted compliance is reached the first time.
  std::atomic<bool> stop = false;
  const StationaryState state = solve_stationary(
      test::problem({6, 2.29, 0}, 1e-6), [&](const BranchStep& point) { stop = point.compliance == 1; }, &stop);
  EXPECT_EQ(state.outcome.status, Status::stopped);
  EXPECT_EQ(state.outcome.reached, 1);
  EXPECT_NEAR(state.shape.deformation, 0.0382, 1e-3);  // of a coarse mesh
}

TEST(Failure, ACellFarTooSoftKeepsTheLastStateOfTheBranch) {
  // Both laws, sizes from small to large: the surface wrinkles or the branch ends; finite numbers, a sentence with the
  // ratio of the moduli, and no claim of accuracy.
  for (const test::CellInChannel& cell : {test::CellInChannel{6, 0.3, 0}, {6, 0.3, 1}, {8.75, 0.5, 1}}) {
    const StationaryState state = solve_stationary(test::problem(cell));
    const Status status = state.outcome.status;
    EXPECT_TRUE(status == Status::surface_unstable || status == Status::branch_ended) << name(status);
    EXPECT_GT(state.outcome.reached, 0);
    EXPECT_LT(state.outcome.reached, 1);
    EXPECT_GT(state.shape.deformation, 0.02);
    EXPECT_LT(state.shape.deformation, 0.5);
    EXPECT_TRUE(std::isfinite(state.cell_velocity) && std::isfinite(state.pressure_drop));
    EXPECT_TRUE(std::isnan(state.estimated_error));
    EXPECT_NE(state.outcome.message.find("times the requested moduli"), std::string::npos) << state.outcome.message;
  }
}

TEST(Failure, AShellWithoutTensionWrinklesAtOnce) {
  // In the tube and in the square: to first order the mean tension of a sphere does not change.
  for (const Section section : {Section::tube, Section::square}) {
    Problem problem;
    problem.section = section;
    problem.radius_ratio = 0.55;
    problem.bulk = {BulkLaw::none, 0};
    problem.cortex = {CortexLaw::neo_hookean, 20, 0, 0};
    const StationaryState state = solve_stationary(problem);
    EXPECT_EQ(state.outcome.status, Status::surface_unstable) << name(state.outcome.status);
    EXPECT_EQ(state.outcome.reached, 0);
    EXPECT_NE(state.outcome.message.find("tension"), std::string::npos) << state.outcome.message;
  }
}

TEST(Failure, AnAccuracyBeyondReachIsNamed) {
  // 1e-15 is below rounding: the state is kept, its error is estimated, the status is not `converged`.
  const StationaryState state = solve_stationary(test::problem({6, 20, 1}, 1e-15));
  EXPECT_EQ(state.outcome.status, Status::accuracy_not_reached) << name(state.outcome.status);
  EXPECT_EQ(state.outcome.reached, 1);
  EXPECT_GT(state.estimated_error, 1e-15);
}

}  // namespace
}  // namespace rheocyte::failure_test
