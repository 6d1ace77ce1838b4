// Reference values: an implementation in another language of the same series, all printed digits converged.
#include "analytic/sphere_in_tube.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rheocyte::sphere_in_tube_test {
namespace {

struct Reference {
  double lambda, velocity, drag_towed, drag_held, pressure_drop;
};
constexpr Reference reference[] = {
    {0.05, 0.9983333834, 1.11727054, 1.11540848, 2.500001422e-06},
    {0.10, 0.9933349657, 1.26321391, 1.25479454, 8.000144162e-05},
    {0.20, 0.9733890720, 1.67947888, 1.63478639, 2.561417455e-03},
    {0.30, 0.9404588040, 2.37009489, 2.22897661, 1.951674331e-02},
    {0.40, 0.8954058450, 3.59137327, 3.21573662, 8.318308244e-02},
    {0.50, 0.8399233708, 5.94737425, 4.99533862, 2.609195891e-01},
    {0.60, 0.7765134596, 11.09189677, 8.61300714, 6.861877258e-01},
    {0.70, 0.7081393135, 24.67598385, 17.47403426, 1.642885950e+00},
    {0.80, 0.6377428196, 74.66996625, 47.62023481, 3.867722801e+00},
    {0.90, 0.5678158862, 469.22439052, 266.43306313, 1.031915278e+01},
    {0.95, 0.5335947141, 2808.80151288, 1498.76164024, 2.074506627e+01},
};

TEST(SphereInTube, VelocityDragAndPressureDropAreThoseOfTheReference) {
  // Eleven radii from 0.05 to 0.95 of the tube's; half a unit of the last printed digit, and 1e-10 for the truncation.
  for (const auto& expected : reference) {
    const SphereInTube sphere = sphere_in_tube(expected.lambda);
    EXPECT_NEAR(sphere.velocity, expected.velocity, 0.6e-10 + 1e-10 * expected.velocity) << expected.lambda;
    EXPECT_NEAR(sphere.drag_towed, expected.drag_towed, 0.6e-8 + 1e-10 * expected.drag_towed) << expected.lambda;
    EXPECT_NEAR(sphere.drag_held, expected.drag_held, 0.6e-8 + 1e-10 * expected.drag_held) << expected.lambda;
    EXPECT_NEAR(sphere.pressure_drop / expected.pressure_drop, 1, 6e-10) << expected.lambda;
    EXPECT_NEAR(sphere.velocity, sphere.drag_held / sphere.drag_towed, 1e-14);
  }
}

TEST(SphereInTube, NoForceActsOnIt) {
  // The resultant of the traction vanishes: N_1 = -2 T_1; the system for the largest sphere has condition 1e4.
  for (const auto& [lambda, velocity, towed, held, drop] : reference) {
    const SurfaceModes traction = sphere_in_tube(lambda).traction;
    EXPECT_NEAR(traction.normal(0), -2 * traction.tangential(0), 1e-11 * std::abs(traction.normal(0))) << lambda;
  }
}

TEST(SphereInTube, TheLargestSphereHasConverged) {
  const int functions = functions_for(max_sphere_in_tube);
  const SphereInTube sphere = sphere_in_tube(max_sphere_in_tube),
                     fewer = sphere_in_tube(max_sphere_in_tube, functions - 2);
  EXPECT_NEAR(fewer.velocity / sphere.velocity, 1, 1e-9);
  EXPECT_NEAR(fewer.drag_towed / sphere.drag_towed, 1, 1e-9);
  EXPECT_NEAR(fewer.pressure_drop / sphere.pressure_drop, 1, 1e-9);
  EXPECT_NEAR(sphere.traction.normal(0), -2 * sphere.traction.tangential(0),
              1e-11 * std::abs(sphere.traction.normal(0)));
}

TEST(SphereInTube, ASmallSphereFollowsTheKnownLimits) {
  // U = 1 - 2/3 lambda^2, N_1 = 4 lambda, T_1 = -2 lambda, N_3 = 7/2 lambda, T_3 = 7/6 lambda, drop = 8 lambda^5; the
  // next orders are lambda^3 relative and more. Drag of the towed sphere: 1 + 2.10444 lambda + 2.10444^2 lambda^2.
  for (const double lambda : {0.01, 0.02}) {
    const SphereInTube sphere = sphere_in_tube(lambda);
    const double next_order = 5 * std::pow(lambda, 3);
    EXPECT_NEAR(sphere.velocity, 1 - 2.0 / 3 * lambda * lambda, next_order);
    EXPECT_NEAR(sphere.traction.normal(0) / (4 * lambda), 1, next_order);
    EXPECT_NEAR(sphere.traction.tangential(0) / (-2 * lambda), 1, next_order);
    EXPECT_NEAR(sphere.traction.normal(1) / (3.5 * lambda), 1, next_order);
    EXPECT_NEAR(sphere.traction.tangential(1) / (7.0 / 6 * lambda), 1, next_order);
    EXPECT_NEAR(sphere.pressure_drop / (8 * std::pow(lambda, 5)), 1, next_order);
    const double wall = 2.1044431 * lambda;
    EXPECT_NEAR(sphere.drag_towed, 1 + wall + wall * wall, 2 * std::pow(wall, 3));
  }
}

TEST(SphereInTube, CoefficientsOfTheStreamFunctionAreThoseOfTheReference) {
  // Scaled coefficients of n = 2 .. 10 at half the tube's radius, printed with eleven digits.
  constexpr double expected[5][4] = {
      {-1.6747431373e-02, 0, 4.1868578432e-02, -2.5121147059e-02},  // the reference has B = -4e-16
      {6.7909334367e-02, -9.5205103614e-02, 2.7625858000e-02, -3.3008875229e-04},
      {-2.0315954604e-03, 2.5046995108e-03, -5.7047681666e-04, 9.7372766285e-05},
      {4.1260348135e-04, -4.7877407118e-04, 8.3675942436e-05, -1.7505352598e-05},
      {-6.1228788551e-05, 6.8721803941e-05, -9.9548576512e-06, 2.4618422615e-06}};
  const SphereInTube sphere = sphere_in_tube(0.5);
  for (int i = 0; i < 5; ++i) {
    const double found[4] = {sphere.A(i), sphere.B(i), sphere.C(i), sphere.D(i)};
    for (int j = 0; j < 4; ++j) EXPECT_NEAR(found[j], expected[i][j], 1e-10 * std::abs(expected[i][j]) + 1e-15);
  }
}

TEST(SphereInTube, TractionIsThatOfTheReference) {
  // Modes 1 to 15 at half the tube's radius, printed with eleven digits.
  constexpr double expected[8][2] = {{2.0096917647e+00, -1.0048458824e+00},  {1.9199463324e+00, 6.3073962574e-01},
                                     {-6.4163495336e-02, -1.1347439805e-02}, {1.3128333837e-02, 1.6932776946e-03},
                                     {-1.9611418450e-03, -1.9850168525e-04}, {2.4053438859e-04, 1.9985923270e-05},
                                     {-2.5732128436e-05, -1.8090998940e-06}, {2.4866807491e-06, 1.5114168476e-07}};
  const SurfaceModes traction = sphere_in_tube(0.5).traction;
  for (int j = 0; j < 8; ++j) {
    // The highest modes are the first to feel the truncation, at 1e-10 of the lowest.
    EXPECT_NEAR(traction.normal(j), expected[j][0], 1e-10 * std::abs(expected[j][0]) + 1e-14);
    EXPECT_NEAR(traction.tangential(j), expected[j][1], 1e-10 * std::abs(expected[j][1]) + 1e-14);
  }
}

// eq:stream-function at (z, rho), summed as it stands; converges for distances from the centre below 2 - lambda.
double stream_function(const SphereInTube& sphere, double z, double rho) {
  const double r = std::hypot(z, rho), x = z / r, ratio = r / sphere.lambda;
  double psi = 0;
  for (int j = 0; j < sphere.A.size(); ++j) {
    const unsigned n = 2 * static_cast<unsigned>(j + 1);
    const double gegenbauer = (std::legendre(n - 2, x) - std::legendre(n, x)) / (2 * n - 1);
    psi += gegenbauer * (sphere.A(j) * std::pow(ratio, 1.0 - n) + sphere.B(j) * std::pow(ratio, 3.0 - n) +
                         sphere.C(j) * std::pow(ratio, n) + sphere.D(j) * std::pow(ratio, n + 2.0));
  }
  return psi;
}

// (u_z, u_rho) by central differences of the stream function: error 1e-6^2 in the formula, 1e-10 by rounding.
std::pair<double, double> velocity(const SphereInTube& sphere, double z, double rho) {
  constexpr double h = 1e-5;
  const auto psi = [&](double dz, double drho) { return stream_function(sphere, z + dz, rho + drho); };
  return {(psi(0, h) - psi(0, -h)) / (2 * h * rho), -(psi(h, 0) - psi(-h, 0)) / (2 * h * rho)};
}

TEST(SphereInTube, TheLiquidSticksToTheWallAndToTheSphere) {
  // In the frame of the sphere the wall moves with -U and the sphere rests: the wall is nowhere among the unknowns, so
  // this checks the reflection, its re-expansion and the solution together.
  constexpr double differences = 1e-8;
  for (const double lambda : {0.2, 0.5}) {
    const SphereInTube sphere = sphere_in_tube(lambda, functions_for(max_sphere_in_tube));
    for (const double z : {0.0, 0.2, 0.4, 0.6}) {
      const auto [along, across] = velocity(sphere, z, 1);
      EXPECT_NEAR(along, -sphere.velocity, differences) << lambda << ' ' << z;
      EXPECT_NEAR(across, 0, differences) << lambda << ' ' << z;
    }
    for (const double theta : {0.3, 1.0, 2.0}) {
      const auto [along, across] = velocity(sphere, lambda * std::cos(theta), lambda * std::sin(theta));
      EXPECT_NEAR(std::hypot(along, across), 0, differences) << lambda << ' ' << theta;
    }
  }
}

TEST(SphereInTube, TheChosenNumberOfFunctionsIsEnough) {
  // The default differs from the longest series by less than the promised 1e-10.
  for (const double lambda : {0.05, 0.3, 0.6, 0.8, 0.9}) {
    const SphereInTube chosen = sphere_in_tube(lambda);
    const SphereInTube longest = sphere_in_tube(lambda, functions_for(max_sphere_in_tube));
    EXPECT_NEAR(chosen.velocity / longest.velocity, 1, 1e-10) << lambda;
    EXPECT_NEAR(chosen.pressure_drop / longest.pressure_drop, 1, 1e-10) << lambda;
    const Eigen::ArrayXd difference = chosen.traction.normal - longest.traction.normal.head(chosen.traction.size());
    EXPECT_LT(difference.abs().maxCoeff(), 1e-9 * longest.traction.normal.abs().maxCoeff()) << lambda;
  }
}

}  // namespace
}  // namespace rheocyte::sphere_in_tube_test
