#include "laws/surface_form.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "derivative_error.h"
#include "random_states.h"

namespace rheocyte::surface_form_test {
namespace {

using test::derivative_error;
using test::RandomStates;
using test::states;

constexpr double rounding = 1e-12;

/// Simpson's rule over the meridian of a sphere round (x0, 0), t = angle from the flow direction: for trigonometric
/// polynomials of low degree exact to rounding.
template <class Function>
double over_sphere(double radius, double x0, const Function& f) {
  constexpr int intervals = 2000;
  double sum = 0;
  for (int i = 1; i < intervals; ++i) {  // everything vanishes at the poles
    const double t = M_PI * i / intervals, c = radius * std::cos(t), s = radius * std::sin(t);
    sum += (i % 2 ? 4 : 2) * f(SurfaceFields<double>{{x0 + c, s}, {-s, c}, {-c, -s}, 0}, t);
  }
  return sum * M_PI / (3 * intervals);
}

/// Of modulus 1; the others' Poisson's ratio is 1/2.
Cortex shell(CortexLaw law) { return {.law = law, .modulus = 1, .tension = 0.4}; }

constexpr std::array shells{CortexLaw::linear, CortexLaw::thin_shell, CortexLaw::neo_hookean,
                            CortexLaw::neo_hookean_reference, CortexLaw::skalak};

TEST(ResistanceToCompression, IsTheSlopeOfTheTension) {
  constexpr double h = test::difference_step;
  RandomStates random;
  for (const CortexLaw law : shells)
    for (int i = 0; i < states; ++i) {
      const double l1 = random.number(0.4, 1.5), l2 = random.number(0.6, 1.5);
      const auto tension = [&](double along) { return principal_tensions(shell(law), along, l2)[0]; };
      const double slope = l1 * (tension(l1 + h) - tension(l1 - h)) / (2 * h);
      EXPECT_NEAR(resistance_to_compression(shell(law), l1, l2), slope,
                  test::derivative_tolerance * std::max(1.0, slope));
    }
}

TEST(ResistanceToCompression, AtRestIsThatOfAPlateBetweenWalls) {
  // E2D / (1 - nu^2).
  for (const CortexLaw law : shells)
    EXPECT_NEAR(resistance_to_compression(shell(law), 1, 1), 1 / (1 - std::pow(poisson_ratio(shell(law)), 2)),
                rounding);
}

TEST(ResistanceToCompression, OfSkalakAndThinShellEndsWhereTheTensionIsLeast) {
  // l1^2 = (1 + C l2^2) / (3 (1 + C l2^4)); thin shell: T1 = K/2 (3 l1^2 + ...), least at l1 = 1 - l2 / 3.
  for (const double l2 : {0.85, 1.0, 1.2}) {
    const double skalak = std::sqrt((1 + l2 * l2) / (3 * (1 + std::pow(l2, 4)))), thin = 1 - l2 / 3;
    EXPECT_NEAR(resistance_to_compression(shell(CortexLaw::skalak), skalak, l2), 0, rounding) << l2;
    EXPECT_NEAR(resistance_to_compression(shell(CortexLaw::thin_shell), thin, l2), 0, rounding) << l2;
    EXPECT_LT(resistance_to_compression(shell(CortexLaw::skalak), 0.95 * skalak, l2), 0) << l2;
    EXPECT_LT(resistance_to_compression(shell(CortexLaw::thin_shell), 0.95 * thin, l2), 0) << l2;
  }
}

TEST(ResistanceToCompression, OfNeoHookeanAndLinearShellsHasNoEnd) {
  for (const CortexLaw law : {CortexLaw::neo_hookean, CortexLaw::neo_hookean_reference, CortexLaw::linear})
    for (double l1 = 0.02; l1 < 3; l1 *= 1.1)
      for (double l2 = 0.3; l2 < 3; l2 *= 1.1) EXPECT_GT(resistance_to_compression(shell(law), l1, l2), 0);
}

TEST(SurfacePoint, ASphereHasItsVolumeAndTheFirstMomentOfItsCentre) {
  // Volume / (2 pi) = 2/3 a^3, int x dV / (2 pi) = x0 of that.
  constexpr double a = 0.8, x0 = 0.3;
  const SurfacePoint form{{}, 0, {}};
  EXPECT_NEAR(over_sphere(a, x0, [&](const auto& f, double) { return form(f).volume; }), -2.0 / 3 * a * a * a, 1e-11);
  EXPECT_NEAR(over_sphere(a, x0, [&](const auto& f, double) { return form(f).moment; }), 2.0 / 3 * a * a * a * x0,
              1e-11);
}

TEST(SurfacePoint, ASphereUnderTensionIsHeldByThePressureOfLaplace) {
  // The work on a smooth test field vanishes if p = 2 gamma / a, and is that of p - 2 gamma / a on the volume else.
  constexpr double a = 0.8, gamma = 0.7, excess = 0.05;
  for (const double p : {0.0, excess}) {
    const SurfacePoint form{{CortexLaw::none, 0, gamma, 0}, 2 * gamma / a, {0, a, 1}};
    const auto work = [&](auto f, double t) {  // test field: the unit normal, phi = (cos t, sin t)
      f.p = p;
      const auto flux = form(f);
      const Components<double, 2> normal(std::cos(t), std::sin(t)), turned(-std::sin(t), std::cos(t));
      return dot(flux.value, normal) + dot(flux.slope, turned);
    };
    EXPECT_NEAR(over_sphere(a, 0, work), -p * 2 * a * a, 1e-11);  // - p dV, dV / (2 pi) = 2 a^2
  }
}

TEST(SurfacePoint, BendingNeitherMovesNorSwellsASphere) {
  // The bending energy of a sphere, 2 pi c_b, does not depend on its radius or place.
  const SurfacePoint form{{CortexLaw::none, 0, 0, 4}, 0, {0, 0.8, 1}};
  const auto inflate = [&](const auto& f, double t) {
    const auto flux = form(f);
    const Components<double, 2> normal(std::cos(t), std::sin(t)), turned(-std::sin(t), std::cos(t));
    return dot(flux.value, normal) + dot(flux.slope, turned) - dot(flux.second, normal);
  };
  EXPECT_NEAR(over_sphere(0.8, 0, inflate), 0, 1e-11);
  for (const double radius : {0.5, 2.0}) {
    const double energy = over_sphere(radius, 0, [&](const auto& f, double) {
      const Meridian<double> m = f.meridian();
      return bending_energy({CortexLaw::none, 0, 0, 4}, m.curvatures()[0] + m.curvatures()[1]) * m.r * m.speed();
    });
    EXPECT_NEAR(2 * M_PI * energy, 2 * M_PI * 4, 1e-10);
  }
}

TEST(SurfacePoint, ItsDerivativesAreExact) {
  // All contributions together at random points of the meridian.
  RandomStates random;
  const SurfacePoint form{{CortexLaw::neo_hookean, 2, 0.3, 0.5, 1.2, 0.7}, 0.4, {-0.9, 0.4, 0.6}};
  for (int i = 0; i < states; ++i) {
    const std::array<double, 7> f = {random.number(-1, 1),     random.number(0.4, 1), random.number(-1.3, -0.7),
                                     random.number(-0.5, 0.5), random.number(-1, 1),  random.number(-1, 1),
                                     random.number(-1, 1)};
    // Second derivatives of the curvature: larger higher ones than elsewhere.
    EXPECT_LT(derivative_error(test::numberwise<SurfaceFields>(form), f), 10 * test::derivative_tolerance);
  }
}

std::array<double, 9> random_kink(RandomStates& random) {
  std::array<double, 9> f;
  for (const int side : {0, 4}) {
    f[side] = random.number(-1.3, -0.7);
    f[side + 1] = random.number(-0.5, 0.5);
    f[side + 2] = random.number(-1, 1);
    f[side + 3] = random.number(-1, 1);
  }
  f[8] = random.number(0.4, 1);
  return f;
}

TEST(SurfaceKink, PiecesThatMeetSmoothlyHaveNoEnergy) {
  // Whatever the lengths of their tangents and their curvatures.
  RandomStates random;
  const SurfaceKink energy{{CortexLaw::none, 0, 0, 2}, 64};
  for (int i = 0; i < states; ++i) {
    auto f = random_kink(random);
    f[4] = 1.7 * f[0];
    f[5] = 1.7 * f[1];
    EXPECT_NEAR(energy(f), 0, rounding);
  }
}

TEST(SurfaceKink, AKinkHasTheSignOfTheCurvature) {
  // Turning further the way a sphere turns raises the energy by moment times angle, and a penalty.
  const double alpha = 1e-6;
  const std::array<double, 9> f = {-1, 0, 0, -1, -std::cos(alpha), -std::sin(alpha), 0, -1, 1};  // top of a unit sphere
  const SurfaceKink energy{{CortexLaw::none, 0, 0, 4}, 0};
  EXPECT_NEAR(energy(f) / (alpha * 2), 1, 1e-5);  // c_b/4 r (1/a + 1/a) alpha
}

TEST(SurfaceKink, ItsDerivativesAreExact) {
  // Slopes of the energy by dual numbers, and their derivatives by dual numbers of dual numbers.
  RandomStates random;
  const SurfaceKink energy{{CortexLaw::none, 0, 0, 1}, 1};
  const auto slopes = [&](const auto& f) { return value_and_slopes(energy, f).second; };
  const auto value = [&](const auto& f) { return std::array{energy(f)}; };
  for (int i = 0; i < states; ++i) {
    const auto f = random_kink(random);
    EXPECT_LT(derivative_error(value, f), test::derivative_tolerance);
    EXPECT_LT(derivative_error(slopes, f), 10 * test::derivative_tolerance);
  }
}

}  // namespace
}  // namespace rheocyte::surface_form_test
