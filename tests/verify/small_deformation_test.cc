// A little deformed cell has the deformation of linear elasticity, whatever its law.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solve/stationary.h"

namespace rheocyte::small_deformation_test {
namespace {

/// d / Ca^2 for Ca = eta Q / (R^3 E) -> 0: traction on the rigid sphere (series solution) and the linear elastic sphere
/// (the model of Mietke et al. 2015, doi 10.1016/j.bpj.2015.09.006, re-derived for the tube; docs/verification.md).
struct LinearResponse {
  double lambda, per_square;
};
constexpr LinearResponse exact[] = {{0.3, 1.99556793e-01}, {0.5, 6.41486625e-01}, {0.7, 2.15020931e+00}};

/// Relative difference of the deformation from the linear response where that is `deformation`.
double difference(const LinearResponse& response, double deformation, double c1_fraction) {
  const double capillary = std::sqrt(deformation / response.per_square);
  Problem problem;
  problem.radius_ratio = response.lambda;
  problem.bulk.law = c1_fraction == 0 ? BulkLaw::linear : BulkLaw::neo_hookean;
  problem.bulk.shear_modulus = std::numbers::pi / (3 * capillary);  // E = 3 mu, and eta Q / R^3 = pi S
  problem.accuracy = 1e-5;
  const StationaryState state = solve_stationary(problem);
  EXPECT_EQ(state.outcome.status, Status::converged) << state.outcome.message;
  return state.shape.deformation / deformation - 1;
}

class SmallDeformation : public testing::TestWithParam<LinearResponse> {};

TEST_P(SmallDeformation, TendsToTheLinearResponseOfTheSolid) {
  // The difference falls with Ca, in proportion to Ca^2, and is below 0.5 % at d = 1e-4, for both laws.
  for (const double c1_fraction : {0.0, 1.0}) {
    const double coarse = difference(GetParam(), 1e-3, c1_fraction);
    const double fine = difference(GetParam(), 1e-4, c1_fraction);
    const double finest = difference(GetParam(), 1e-6, c1_fraction);
    EXPECT_LT(std::abs(fine), 5e-3);      // wanted of the program; it has 6e-4 at most
    EXPECT_NEAR(coarse / fine, 10, 0.5);  // next order: 1 + c Ca^2 + ..., c d of 1e-2 at most
    EXPECT_LT(std::abs(finest), 2e-5);    // accuracy asked for, 1e-5, twice; the physical rest is 6e-6
  }
}

INSTANTIATE_TEST_SUITE_P(Lambda, SmallDeformation, testing::ValuesIn(exact),
                         [](const auto& test) { return std::to_string(int(100 * test.param.lambda + 0.5)); });

}  // namespace
}  // namespace rheocyte::small_deformation_test
