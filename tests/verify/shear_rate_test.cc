// The greatest shear rate beside the cell is that of exact flows, and converges with the resolution.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "analytic/sphere_in_tube.h"
#include "solve/stationary.h"

namespace rheocyte::shear_rate_test {
namespace {

/// Strains of 1e-5 and less.
Problem stiff_cell(double radius_ratio) {
  Problem problem;
  problem.radius_ratio = radius_ratio;
  problem.bulk.shear_modulus = 1e5;
  return problem;
}

double shear_rate_max(const Problem& problem) {
  const StationaryState state = solve_stationary(problem);
  EXPECT_EQ(state.outcome.status, Status::converged) << state.outcome.message;
  return state.shear_rate_max;
}

/// On the rigid sphere, where nothing slips, the shear rate is the tangential traction over the viscosity; in U/R.
double max_on_rigid_sphere(double radius_ratio) {
  const SurfaceModes traction = sphere_in_tube(radius_ratio).traction;
  constexpr double max_speed = 2;
  double greatest = 0;
  for (double theta = 0.01; theta < std::numbers::pi; theta += 0.001) {
    const double x = std::cos(theta);
    double shear = 0;
    for (int j = 0; j < traction.size(); ++j) {
      const unsigned l = 2 * unsigned(j) + 1;
      shear += traction.tangential(j) * l * (x * std::legendre(l, x) - std::legendre(l - 1, x)) / std::sin(theta);
    }
    greatest = std::max(greatest, std::abs(shear));
  }
  return max_speed * greatest;
}

TEST(ShearRate, BesideASmallCellIsThatOfTheUndisturbedFlowAtTheWall) {
  // (3 n + 1) / n U/R; the cell of 0.05 R disturbs it by the cube of its radius, the regularisation of the power law
  // by 1e-6.
  Problem problem = stiff_cell(0.05);
  EXPECT_NEAR(shear_rate_max(problem) / 4, 1, 1e-4);
  problem.liquid.law = LiquidLaw::power_law;
  problem.liquid.exponent = 0.6039;
  EXPECT_NEAR(shear_rate_max(problem) / (3 + 1 / 0.6039), 1, 1e-4);
}

TEST(ShearRate, InANarrowGapIsThatOnTheRigidSphere) {
  // In gaps of 0.2 and 0.1 R the cell drags behind the liquid's mean, so that the shear rate is greatest on its
  // surface.
  for (const double radius_ratio : {0.8, 0.9})
    EXPECT_NEAR(shear_rate_max(stiff_cell(radius_ratio)) / max_on_rigid_sphere(radius_ratio), 1, 1e-3) << radius_ratio;
}

TEST(ShearRate, ConvergesWithTheResolution) {
  // A cell of the paper. Velocities lose an order when they are differentiated, and the points at which the polynomials
  // are looked at miss the greatest value by 4e-5.
  Problem problem;
  problem.radius_ratio = 6 / 10.94;
  problem.bulk.law = BulkLaw::linear;
  problem.bulk.shear_modulus = 4580 / 3 / 145.864;
  const auto at_accuracy = [&](double accuracy) {
    problem.accuracy = accuracy;
    return shear_rate_max(problem);
  };
  const double exact = at_accuracy(1e-7);
  EXPECT_NEAR(at_accuracy(1e-3) / exact, 1, 1e-3);
  EXPECT_NEAR(at_accuracy(1e-5) / exact, 1, 4e-4);
  EXPECT_NEAR(at_accuracy(1e-6) / exact, 1, 1e-4);
}

}  // namespace
}  // namespace rheocyte::shear_rate_test
