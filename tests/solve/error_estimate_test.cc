// The estimated error is honest and the wanted accuracy is met.
#include <gtest/gtest.h>

#include <cmath>

#include "cases.h"
#include "solve/stationary.h"

namespace rheocyte {
namespace {

class ErrorEstimate : public testing::TestWithParam<Problem> {};

TEST_P(ErrorEstimate, TheTrueErrorIsBelowTheEstimateAndTheWantedAccuracy) {
  // Against a solution of accuracy 1e-7, for accuracies 1e-2, 1e-3 and 1e-4.
  Problem problem = GetParam();
  problem.accuracy = 1e-7;
  const StationaryState exact = solve_stationary(problem);
  ASSERT_EQ(exact.outcome.status, Status::converged) << exact.outcome.message;
  for (const double accuracy : {1e-2, 1e-3, 1e-4}) {
    problem.accuracy = accuracy;
    const StationaryState state = solve_stationary(problem);
    const double error = std::abs(state.shape.deformation / exact.shape.deformation - 1);
    EXPECT_EQ(state.outcome.status, Status::converged);
    EXPECT_LE(state.estimated_error, accuracy);
    EXPECT_LE(error, accuracy);
    // The exact value itself is good to 1e-7.
    EXPECT_LE(error, state.estimated_error + 1e-7) << "wanted " << accuracy;
  }
}

std::string case_name(const testing::TestParamInfo<Problem>& cell) {
  constexpr std::array names = {"Linear", "NeoHookean", "Small", "Large", "PowerLaw"};
  return names[cell.index];
}

INSTANTIATE_TEST_SUITE_P(Cells, ErrorEstimate,
                         testing::Values(test::problem({6, 2.29, 0}), test::problem({7.66, 3.437, 1}),
                                         test::problem({3, 1, 1}), test::problem({8.75, 6, 0.5}),
                                         test::in_power_law_liquid(test::problem({6, 1.75, 0}))),
                         case_name);

}  // namespace
}  // namespace rheocyte
