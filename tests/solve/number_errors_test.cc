// Every number of a state has an error of its own, and it is honest.
#include "solve/number_errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cases.h"
#include "solve/stationary.h"
#include "solve/transient.h"

namespace rheocyte::number_errors_test {
namespace {

/// Differences below this fraction of a number are rounding and the tolerance of Newton's method.
constexpr double fraction_of_rounding = 1e-9;

/// Each number is as far from that of a much finer state as `factor` times the errors of both say at most; those that
/// do not exist have no error. Of random cells one number in fifty is farther off than it says (docs/verification.md).
void expect_honest(const StationaryState& state, const StationaryState& fine, double factor = 1.5) {
  for (const StateMeasure& measure : state_measures) {
    const double value = measure.value(state), other = measure.value(fine), error = measure.value(state.errors);
    if (measure.name == "offset_error_um") continue;
    EXPECT_EQ(std::isnan(value), std::isnan(error)) << measure.name;
    if (std::isnan(value)) continue;
    const double rounding = fraction_of_rounding * std::max(std::abs(value), fraction_of_rounding);
    EXPECT_LE(std::abs(value - other), factor * (error + measure.value(fine.errors)) + rounding)
        << measure.name << " " << value << " " << other;
  }
}

class NumberErrors : public testing::TestWithParam<Problem> {};

TEST_P(NumberErrors, InATubeAreHonest) {
  // Against a state that is better than 1e-6, at accuracies 1e-2 to 1e-4.
  Problem problem = GetParam();
  problem.accuracy = 1e-7;
  const StationaryState fine = solve_stationary(problem);
  ASSERT_LT(fine.estimated_error, 1e-6) << fine.outcome.message;
  for (const double accuracy : {1e-2, 1e-3, 1e-4}) {
    SCOPED_TRACE(accuracy);
    problem.accuracy = accuracy;
    expect_honest(solve_stationary(problem), fine);
  }
}

Problem combined_cell() {
  Problem problem = test::problem({6, 1.5, 1});
  problem.cortex = {CortexLaw::neo_hookean_reference, 3, 1};
  problem.bulk.axial_tension = 0.5;
  return problem;
}

Problem shell() {
  Problem problem = test::problem({7, 3, 1});
  problem.bulk = {.law = BulkLaw::none};
  problem.cortex = {CortexLaw::neo_hookean, 20, 2};
  return problem;
}

INSTANTIATE_TEST_SUITE_P(Cells, NumberErrors,
                         testing::Values(test::problem({6, 2.29, 0}), test::problem({7.66, 3.437, 1}),
                                         test::problem({3, 1, 1}), test::problem({8.75, 6, 0.5}),
                                         test::problem({6, 50, 1}),
                                         test::in_power_law_liquid(test::problem({6, 1.75, 0})), combined_cell(),
                                         shell()));

/// In the square channel, beside its axis or on it.
class NumberErrorsInASquare : public testing::TestWithParam<double> {};

TEST_P(NumberErrorsInASquare, AreHonest) {
  Problem problem;
  problem.section = Section::square;
  problem.radius_ratio = 0.6;
  problem.bulk = {.law = BulkLaw::neo_hookean, .shear_modulus = 5, .axial_tension = 0.8};
  problem.offset = GetParam();
  if (problem.offset == 0)
    problem.cortex = {CortexLaw::neo_hookean_reference, 2, 0.5};
  else
    problem.bulk.shear_modulus = 10;
  problem.accuracy = 3e-4;
  const StationaryState fine = solve_stationary(problem);
  ASSERT_LT(fine.estimated_error, 1e-3) << fine.outcome.message;
  problem.accuracy = 1e-2;
  const StationaryState state = solve_stationary(problem);
  ASSERT_LT(state.statistics.degree, fine.statistics.degree);
  expect_honest(state, fine);
}

INSTANTIATE_TEST_SUITE_P(Offsets, NumberErrorsInASquare, testing::Values(0, 0.1));

TEST(NumberErrors, OfAStateOnTheWayAreNotKnown) {
  // The branch of this soft cell ends before it.
  const StationaryState state = solve_stationary(test::problem({6, 0.5, 0}));
  ASSERT_LT(state.outcome.reached, 1);
  for (const StateMeasure& measure : state_measures) EXPECT_TRUE(std::isnan(measure.value(state.errors)));
}

TEST(NumberErrors, InTimeAreTheChangesToCoarserStepsAndACoarserMesh) {
  // Against a mesh two degrees finer, with steps whose error is far less.
  Problem problem = test::problem({7, 4.58, 1});
  problem.bulk.viscosity = 1;
  TimeRun run{0.5, 0.5, 1e-7, 4};
  run.estimates_error = true;
  const StationaryState state = transient(problem, run, {});
  run.degree = 6;
  const StationaryState fine = transient(problem, run, {});
  expect_honest(state, fine);
}

TEST(NumberErrors, OfTwoTheGreaterOneIsTakenOfEachNumberThatIsKnown) {
  StateNumbers errors = unknown_numbers(), others = unknown_numbers();
  errors.shape.area = 1;
  others.shape.area = 2;
  errors.shape.perimeter = 3;
  others.shape.perimeter = 1;
  others.cell_velocity = 1;
  take_greater(others, errors);
  EXPECT_EQ(errors.shape.area, 2);
  EXPECT_EQ(errors.shape.perimeter, 3);
  EXPECT_TRUE(std::isnan(errors.cell_velocity));
}

TEST(ErrorOfLast, IsTheRestOfAGeometricSeries) {
  // 1 + 1/2 + 1/4: 1/4 is left. Of two values it is twice their difference; one gives no error.
  EXPECT_DOUBLE_EQ(error_of_last(std::array{1.0, 1.5, 1.75}), 0.25);
  EXPECT_DOUBLE_EQ(error_of_last(std::array{1.0, 1.5}), 1);
  EXPECT_TRUE(std::isinf(error_of_last(std::array{1.0})));
  // A change that is small by chance after a large one: half of the latter.
  EXPECT_DOUBLE_EQ(error_of_last(std::array{1.0, 1.5, 1.5}), 0.25);
}

}  // namespace
}  // namespace rheocyte::number_errors_test
