#include <gtest/gtest.h>

#include "derivative_error.h"
#include "laws/surface_form.h"
#include "random_states.h"

namespace rheocyte::cortex_test {
namespace {

using test::derivative_error;
using test::RandomStates;
using test::states;

constexpr double rounding = 1e-12;
constexpr double E2D = 3;
constexpr std::array laws = {CortexLaw::linear, CortexLaw::thin_shell, CortexLaw::neo_hookean,
                             CortexLaw::neo_hookean_reference, CortexLaw::skalak};

std::array<double, 2> tensions(CortexLaw law, double l1, double l2) {
  return principal_tensions<double>({law, E2D, 0, 0}, l1, l2);
}

TEST(Cortex, AllLawsAgreeToFirstOrder) {
  // T1 = 4/3 E2D (e1 + e2/2): Hooke's law of an incompressible sheet. The difference is of second order in the strain.
  for (const CortexLaw law : laws) {
    for (const double e : {1e-3, 1e-4}) {
      for (const auto& [e1, e2] : {std::array{e, 0.0}, {0.0, e}, {e, e}, {e, -2 * e}}) {
        const auto T = tensions(law, 1 + e1, 1 + e2);
        EXPECT_NEAR(T[0], 4.0 / 3 * E2D * (e1 + e2 / 2), 20 * E2D * e * e);
        EXPECT_NEAR(T[1], 4.0 / 3 * E2D * (e2 + e1 / 2), 20 * E2D * e * e);
      }
    }
    EXPECT_EQ(poisson_ratio({law}), 0.5);
  }
}

Cortex skalak(double area_constant) {
  return {.law = CortexLaw::skalak, .modulus = E2D, .area_constant = area_constant};
}

constexpr std::array area_constants = {0.01, 0.3, 1.0, 10.0, 1000.0};

TEST(SkalakCortex, ItHasTheSurfaceModulusAndThePoissonsRatioOfItsConstant) {
  // T1 = E2D / (1 - nu^2) (e1 + nu e2) with nu = C / (1 + C), by exact derivatives at rest.
  for (const double C : area_constants) {
    const auto one = Dual<double, 2>(1, 0), other = Dual<double, 2>(1, 1);
    const auto T = principal_tensions(skalak(C), one, other);
    const double nu = C / (1 + C), along = T[0].slope(0), across = T[0].slope(1);
    EXPECT_NEAR(across / along, nu, rounding);
    EXPECT_NEAR(poisson_ratio(skalak(C)), nu, rounding);
    EXPECT_NEAR(along * (1 - across / along * across / along) / E2D, 1, rounding * (1 + C));
  }
}

TEST(SkalakCortex, TheTensionsAreThoseOfTheTextbookForEveryConstant) {
  // T1 = G / J [l1^2 (l1^2 - 1) + C J^2 (J^2 - 1)], and they are the derivatives of the energy per reference area.
  RandomStates random;
  for (const double C : area_constants) {
    const double G = E2D * (1 + C) / (2 * (1 + 2 * C));
    for (int i = 0; i < states; ++i) {
      const double a = random.number(0.6, 1.6), b = random.number(0.6, 1.6), J = a * b;
      const double expected = G / J * (a * a * (a * a - 1) + C * J * J * (J * J - 1));
      EXPECT_NEAR(principal_tensions<double>(skalak(C), a, b)[0], expected, rounding * E2D * 100 * (1 + C));
    }
    const auto tensions = [&](const auto& l) { return principal_tensions(skalak(C), l[0], l[1]); };
    EXPECT_LT((derivative_error<2>(tensions, {1.2, 0.8})), test::derivative_tolerance);
  }
}

TEST(SkalakCortex, WithTheConstantOneItIsTheLawThatHadNone) {
  // E2D / 12 [I1^2 + 2 I1 - 2 I2 + I2^2] per reference area, to 1e-14 of the greatest term.
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const double a = random.number(0.6, 1.6), b = random.number(0.6, 1.6), J = a * b;
    const double I1 = a * a + b * b - 2, I2 = J * J - 1;
    const double former = E2D / 12 * (I1 * I1 + 2 * (I1 - I2) + I2 * I2) / J;
    EXPECT_NEAR(shell_energy({CortexLaw::skalak, E2D}, a, b), former, 1e-14 * (1 + former));
  }
}

TEST(Cortex, TheTensionsAreThoseOfTheirSources) {
  // Mokbel et al. 2017, eq. 19 (linear) and eqs. 8, 17 (neo-hookean); the membrane laws of the textbooks.
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const double a = random.number(0.6, 1.6), b = random.number(0.6, 1.6), J = a * b;
    EXPECT_NEAR(tensions(CortexLaw::linear, a, b)[0], 4.0 / 3 * E2D * (a - 1 + 0.5 * (b - 1)), rounding * E2D * 10);
    EXPECT_NEAR(tensions(CortexLaw::neo_hookean, a, b)[0], E2D / 6 * (3 * a * a + b * b - 1 / (J * J) - 3),
                rounding * E2D * 10);
    EXPECT_NEAR(tensions(CortexLaw::neo_hookean_reference, a, b)[1], E2D / 3 * (b / a - 1 / (J * J * J)),
                rounding * E2D * 100);
    EXPECT_NEAR(tensions(CortexLaw::skalak, a, b)[0], E2D / 3 * (a * a * (a * a - 1) + J * J * (J * J - 1)) / J,
                rounding * E2D * 100);
  }
}

TEST(Cortex, TheWorkOfTheTensionsIsTheChangeOfTheEnergy) {
  // d(f l1 l2) = T1 l2 dl1 + T2 l1 dl2 per reference area, and T1 is symmetric to T2.
  RandomStates random;
  for (const CortexLaw law : laws) {
    const Cortex cortex{law, E2D, 0, 0};
    const auto energy = [&](double l1, double l2) { return shell_energy(cortex, l1, l2) * l1 * l2; };
    for (int i = 0; i < states; ++i) {
      const double l1 = random.number(0.6, 1.6), l2 = random.number(0.6, 1.6), h = 1e-5;
      const auto T = tensions(law, l1, l2), swapped = tensions(law, l2, l1);
      // Central differences: h^2/6 times third derivatives of order 100.
      EXPECT_NEAR(T[0] * l2, (energy(l1 + h, l2) - energy(l1 - h, l2)) / (2 * h), 1e-7);
      EXPECT_NEAR(T[1] * l1, (energy(l1, l2 + h) - energy(l1, l2 - h)) / (2 * h), 1e-7);
      EXPECT_NEAR(T[0], swapped[1], rounding * 1000);
    }
  }
}

TEST(Cortex, ItIsAtRestWithoutStretchAndItsEnergyIsPositiveElsewhere) {
  // f(1, 1) = 0 is the least value.
  RandomStates random;
  for (const CortexLaw law : laws) {
    const Cortex cortex{law, E2D, 0, 0};
    EXPECT_NEAR(shell_energy(cortex, 1.0, 1.0), 0, rounding);
    EXPECT_NEAR(tensions(law, 1, 1)[0], 0, rounding);
    for (int i = 0; i < states; ++i) {
      const double l1 = random.number(0.6, 1.6), l2 = random.number(0.6, 1.6);
      EXPECT_GE(shell_energy(cortex, l1, l2), 0);
    }
  }
}

TEST(Cortex, SurfaceTensionAddsToBothTensionsOfAnyLaw) {
  // Also without a shell, and at any stretch.
  for (const CortexLaw law : {CortexLaw::none, CortexLaw::linear, CortexLaw::neo_hookean}) {
    const auto bare = principal_tensions<double>({law, E2D, 0, 0}, 1.2, 0.7);
    const auto tense = principal_tensions<double>({law, E2D, 0.25, 0}, 1.2, 0.7);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(tense[i] - bare[i], 0.25, rounding);
  }
}

TEST(Cortex, ItsDerivativesAreExact) {
  // Dual numbers of dual numbers against central differences.
  RandomStates random;
  for (const CortexLaw law : laws) {
    const Cortex cortex{law, E2D, 0.2, 0};
    const auto T = [&](const auto& l) { return principal_tensions(cortex, l[0], l[1]); };
    for (int i = 0; i < states; ++i)
      EXPECT_LT((derivative_error<2>(T, {random.number(0.7, 1.5), random.number(0.7, 1.5)})),
                test::derivative_tolerance);
  }
}

}  // namespace
}  // namespace rheocyte::cortex_test
