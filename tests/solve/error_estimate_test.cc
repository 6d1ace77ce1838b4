// The estimated error is honest and the wanted accuracy is met.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "cases.h"
#include "solve/stationary.h"

namespace rheocyte {

/// What GoogleTest prints of a case.
void PrintTo(const Problem& problem, std::ostream* out) {
  *out << "radius " << problem.radius_ratio << ", modulus " << problem.bulk.shear_modulus;
}

}  // namespace rheocyte

namespace rheocyte::error_estimate_test {
namespace {

class ErrorEstimate : public testing::TestWithParam<Problem> {};

TEST_P(ErrorEstimate, TheTrueErrorIsBelowTheEstimateAndTheWantedAccuracy) {
  // Against a solution that is better than 1e-6, for accuracies 1e-2, 1e-3 and 1e-4.
  Problem problem = GetParam();
  problem.accuracy = 1e-7;
  const StationaryState exact = solve_stationary(problem);
  ASSERT_LT(exact.estimated_error, 1e-6) << exact.outcome.message;
  for (const double accuracy : {1e-2, 1e-3, 1e-4}) {
    problem.accuracy = accuracy;
    const StationaryState state = solve_stationary(problem);
    const double error = std::abs(state.shape.deformation / exact.shape.deformation - 1);
    EXPECT_EQ(state.outcome.status, Status::converged);
    EXPECT_LE(state.estimated_error, accuracy);
    EXPECT_LE(error, accuracy);
    EXPECT_LE(error, state.estimated_error + exact.estimated_error) << "wanted " << accuracy;
  }
}

std::string case_name(const testing::TestParamInfo<Problem>& cell) {
  constexpr std::array names = {"Linear", "NeoHookean", "Small", "Large", "PowerLaw", "SoftPowerLaw"};
  return names[cell.index];
}

INSTANTIATE_TEST_SUITE_P(Cells, ErrorEstimate,
                         testing::Values(test::problem({6, 2.29, 0}), test::problem({7.66, 3.437, 1}),
                                         test::problem({3, 1, 1}), test::problem({8.75, 6, 0.5}),
                                         test::in_power_law_liquid(test::problem({6, 1.75, 0})),
                                         test::in_power_law_liquid(test::problem({6.3, 1.25, 1}))),
                         case_name);

TEST(ErrorEstimateInANarrowGap, DoesNotTrustTwoDegreesOfTheCoarsestMesh) {
  // Degrees 4 and 5 agree to 5e-5 there, and both are wrong by 1e-3.
  Problem problem = test::problem({10.25, 3.2857, 1}, 5e-6);
  const StationaryState exact = solve_stationary(problem);
  ASSERT_EQ(exact.outcome.status, Status::converged) << exact.outcome.message;
  for (const double accuracy : {1e-2, 1e-3, 1e-4}) {
    problem.accuracy = accuracy;
    const StationaryState state = solve_stationary(problem);
    EXPECT_LE(std::abs(state.shape.deformation / exact.shape.deformation - 1),
              state.estimated_error + exact.estimated_error)
        << "wanted " << accuracy;
  }
}

TEST(ErrorEstimateByChance, OfTwoDegreesThatAgreeByChanceIsNotTheirDifference) {
  // Degrees 4 and 5 agree to 3e-6 in the deformation of this cell, and both are wrong by 3e-4; their inertia ratios
  // differ.
  Problem problem;
  problem.radius_ratio = 0.811625;
  problem.bulk = {BulkLaw::linear, 7.50488, 0};
  problem.accuracy = 1e-5;
  const StationaryState exact = solve_stationary(problem);
  problem.accuracy = 2.5e-4;
  const StationaryState state = solve_stationary(problem);
  EXPECT_LE(std::abs(state.shape.deformation / exact.shape.deformation - 1), 2 * state.estimated_error);
}

}  // namespace
}  // namespace rheocyte::error_estimate_test
