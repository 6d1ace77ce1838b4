#include <gtest/gtest.h>

#include "derivative_error.h"
#include "laws/developed_flow.h"
#include "random_states.h"

namespace rheocyte::liquid_test {
namespace {

using test::RandomStates;
using test::states;

// Some dozen operations on stresses of order ten.
constexpr double rounding = 1e-12;
// From shear thinning stronger than any measured buffer to shear thickening.
constexpr std::array exponents = {0.4, 0.6039, 1.0, 1.5};

Liquid newtonian() { return {}; }
Liquid power_law(double n) { return {LiquidLaw::power_law, n, 0, 0}; }

/// With plateaus of 3 and 0.2 and thinning from the rate 0.5 on, in units of the rate 1.
Liquid carreau(double n, double a) {
  Liquid liquid{LiquidLaw::carreau, n};
  liquid.viscosity = 3;
  liquid.infinite_viscosity = 0.2;
  liquid.relaxation_time = 2;
  liquid.yasuda_exponent = a;
  return in_units_of_rate(liquid, 1);
}

std::vector<Liquid> all_liquids() {
  std::vector<Liquid> liquids = {newtonian()};
  for (const double n : exponents) liquids.push_back(power_law(n));
  liquids.push_back({LiquidLaw::power_law, 0.6, 0.1, 0});
  for (const double a : {0.8, 2.0, 4.0}) liquids.push_back(carreau(0.4, a));
  return liquids;
}

TEST(Liquid, TheStressHasTheDerivativeOfCentralDifferences) {
  // Dual numbers are exact for both laws, regularised or not.
  RandomStates random;
  for (const Liquid& liquid : all_liquids()) {
    const auto law = test::entrywise([&](const auto& L) { return viscous_stress(liquid, L); });
    for (int i = 0; i < states; ++i) {
      // Shear rates near zero have unbounded higher derivatives where n < 1: the differences fail there, not the law.
      const Tensor<double> L = random.tensor(1) + test::diagonal(1, 0, -1);
      if ((L + L.transpose()).norm() < 0.5) continue;
      EXPECT_LT(test::derivative_error<9>(law, L.entries), test::derivative_tolerance);
    }
  }
}

TEST(Liquid, TheStressIsObjective) {
  // An observer who turns by Q and spins sees L* = Q L Q^T + W and the stress Q sigma Q^T.
  RandomStates random;
  for (const Liquid& liquid : all_liquids()) {
    for (int i = 0; i < states; ++i) {
      const Tensor<double> L = random.tensor(1), Q = random.rotation();
      const Tensor<double> seen = viscous_stress(liquid, Tensor<double>(Q * L * Q.transpose() + random.spin()));
      EXPECT_LT((seen - Q * viscous_stress(liquid, L) * Q.transpose()).norm(), rounding);
    }
  }
}

TEST(Liquid, ARigidMotionCausesNoStress) {
  // A pure spin has D = 0.
  RandomStates random;
  for (const Liquid& liquid : {newtonian(), Liquid{LiquidLaw::power_law, 0.6, 1e-3, 0}}) {
    EXPECT_EQ(viscous_stress(liquid, random.spin()).norm(), 0);
  }
}

TEST(Liquid, ThePowerLawOfExponentOneIsNewtonian) {
  // eta = gdot^0 = 1.
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const Tensor<double> L = random.tensor(1);
    EXPECT_LT((viscous_stress(power_law(1), L) - viscous_stress(newtonian(), L)).norm(), rounding);
  }
}

TEST(Liquid, SimpleShearHasTheStressOfThePowerLaw) {
  // tau = gdot^n in simple shear, the other components vanish.
  for (const double n : exponents) {
    for (const double gdot : {0.01, 1.0, 20.0}) {
      Tensor<double> L = Tensor<double>::Zero();
      L(0, 1) = gdot;
      const Tensor<double> sigma = viscous_stress(power_law(n), L);
      EXPECT_NEAR(sigma(0, 1) / std::pow(gdot, n), 1, rounding);
      EXPECT_EQ(sigma(0, 0), 0);
    }
  }
}

TEST(Liquid, ViscousFlowDissipates) {
  // sigma : grad v > 0 for every flow that deforms.
  RandomStates random;
  for (const Liquid& liquid : all_liquids()) {
    for (int i = 0; i < states; ++i) {
      const Tensor<double> L = random.tensor(1);
      EXPECT_GT(dot(viscous_stress(liquid, L), L), 0);
    }
  }
}

TEST(Liquid, InertiaIsTheConvectiveAcceleration) {
  // Re (v . grad) v of v = A x is Re A A x.
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const Tensor<double> A = random.tensor(1);
    const Vector<double> x(random.number(-1, 1), random.number(-1, 1), random.number(-1, 1));
    const Liquid liquid{LiquidLaw::newtonian, 1, 0, 0.7};
    EXPECT_LT((inertia(liquid, Vector<double>(A * x), A) - 0.7 * A * A * x).norm(), rounding);
  }
}

/// By Simpson's rule.
double flow_rate(const Liquid& liquid, int intervals = 2000) {
  double sum = 0;
  for (int i = 0; i <= intervals; ++i) {
    const double r = double(i) / intervals, weight = i == 0 || i == intervals ? 1 : i % 2 ? 4 : 2;
    sum += weight * undisturbed_velocity(liquid, r) * 2 * r;
  }
  return sum / (3 * intervals);
}

TEST(Liquid, TheUndisturbedFlowHasMeanSpeedOne) {
  // int u 2 r dr = 1 and u(1) = 0 for each exponent.
  for (const double n : exponents) {
    // Simpson's rule on r^(2 + 1/n), whose fourth derivative is singular on the axis: h^(3 + 1/n) <= 1e-11.
    EXPECT_NEAR(flow_rate(power_law(n)), 1, 1e-10) << n;
    EXPECT_EQ(undisturbed_velocity(power_law(n), 1), 0);
  }
  EXPECT_DOUBLE_EQ(undisturbed_velocity(newtonian(), 0), 2);
  EXPECT_DOUBLE_EQ(undisturbed_pressure_gradient(newtonian()), 8);
}

TEST(Liquid, TheUndisturbedPressureBalancesTheShearStressAtEveryRadius) {
  // sigma_xr = -(dp/dx) r/2, at the wall and inside.
  constexpr double h = 1e-5;
  for (const double n : exponents) {
    const Liquid liquid = power_law(n);
    for (const double r : {0.2, 0.5, 0.8, 0.99, 1.0}) {
      Tensor<double> L = Tensor<double>::Zero();
      L(0, 1) = (undisturbed_velocity(liquid, r + h) - undisturbed_velocity(liquid, r - h)) / (2 * h);
      // Central difference: h^2/6 u''' and rounding 1e-16/h, both below 1e-9 of the stress.
      const double expected = -undisturbed_pressure_gradient(liquid) * r / 2;
      EXPECT_NEAR(viscous_stress(liquid, L)(0, 1) / expected, 1, 1e-8) << n << ' ' << r;
    }
  }
}

TEST(Liquid, PressureGradientAndMeanSpeedAreInverse) {
  // In any units, for each exponent; Newtonian: 8 eta u.
  for (const double n : exponents) {
    Liquid liquid = power_law(n);
    liquid.viscosity = 0.4;
    for (const double speed : {1e-3, 1.0, 250.0})
      EXPECT_NEAR(undisturbed_mean_speed(liquid, undisturbed_pressure_gradient(liquid, speed)) / speed, 1, rounding);
  }
  EXPECT_DOUBLE_EQ(undisturbed_pressure_gradient(newtonian(), 3), 24);
}

TEST(Liquid, TheWayFromTheNewtonianLiquidHasItsEndsThere) {
  // At fraction 0 the viscosity is 1 everywhere, at fraction 1 it is the liquid itself.
  const Liquid liquid{LiquidLaw::power_law, 0.6, 0.1, 0.3};
  for (const double rate : {0.0, 0.7, 20.0}) EXPECT_EQ(viscosity(at_thinning(liquid, 0), rate * rate), 1);
  EXPECT_EQ(at_thinning(liquid, 1), liquid);
  EXPECT_DOUBLE_EQ(thinning(at_thinning(liquid, 0.25)), 0.25 * thinning(liquid));
}

TEST(Liquid, CarreauIsNewtonianWithoutThinningAndAPowerLawFarBeyondIt) {
  // n = 1 or lambda = 0: the viscosity is 1 at every rate; lambda gdot = 1e6: (gdot)^(n-1), and its flow.
  Liquid level = carreau(1, 2), slow = carreau(0.6, 2), thin = carreau(0.6, 2);
  slow.relaxation_time = thin.infinite_viscosity = 0;
  thin.relaxation_time = 1e6;
  slow = in_units_of_rate(slow, 1);
  thin = in_units_of_rate(thin, 1);
  for (const double rate : {0.1, 1.0, 30.0}) {
    EXPECT_NEAR(viscosity(level, rate * rate), 1, rounding);
    EXPECT_NEAR(viscosity(slow, rate * rate), 1, rounding);
    EXPECT_NEAR(viscosity(thin, rate * rate) / std::pow(rate, 0.6 - 1), 1, 1e-9);  // (lambda gdot)^-2 at 0.1
  }
  EXPECT_NEAR(undisturbed_pressure_gradient(level), 8, 8 * rounding);
  EXPECT_NEAR(undisturbed_pressure_gradient(slow), 8, 8 * rounding);
  const double power = undisturbed_pressure_gradient(power_law(0.6));
  EXPECT_NEAR(undisturbed_pressure_gradient(thin) / power, 1, 1e-9);
  EXPECT_NEAR(undisturbed_velocity(thin, 0.7), undisturbed_velocity(power_law(0.6), 0.7), 1e-9);
}

TEST(Liquid, TheFlowOfALawWithoutClosedFormIsThatOfItsStress) {
  // The shear stress is linear in r, the velocity's slope gives it back, and the mean speed is 1.
  constexpr double h = 1e-4;
  for (const double a : {0.8, 2.0, 4.0}) {
    for (const double n : {0.1, 0.4, 0.8, 1.3}) {
      const Liquid liquid = carreau(n, a);
      EXPECT_NEAR(flow_rate(liquid, 400), 1, 1e-8) << n << ' ' << a;  // near the axis
      EXPECT_EQ(undisturbed_velocity(liquid, 1), 0);
      const double gradient = undisturbed_pressure_gradient(liquid);
      EXPECT_NEAR(undisturbed_mean_speed(liquid, gradient), 1, 10 * rounding);
      for (const double r : {0.2, 0.5, 0.9}) {
        const auto u = [&](double at) { return undisturbed_velocity(liquid, at); };
        const double rate = (8 * (u(r - h) - u(r + h)) - (u(r - 2 * h) - u(r + 2 * h))) / (12 * h);
        EXPECT_NEAR(viscosity(liquid, rate * rate) * rate / (gradient * r / 2), 1, 1e-9) << n << ' ' << a << ' ' << r;
      }
    }
  }
}

TEST(Liquid, UnitsOfTheRateDoNotChangeTheLiquid) {
  // Stress at a rate and pressure gradient, in the units of another rate.
  const Liquid liquid = carreau(0.4, 2);
  constexpr double unit = 7.3;
  const Liquid other = in_units_of_rate(liquid, unit);
  const double stress = stress_at_rate(liquid, unit);
  EXPECT_NEAR(stress_at_rate(other, 1), 1, rounding);
  EXPECT_NEAR(stress_at_rate(other, 2) * stress / stress_at_rate(liquid, 2 * unit), 1, rounding);
  const double gradient = undisturbed_pressure_gradient(liquid, unit);
  EXPECT_NEAR(undisturbed_pressure_gradient(other) * stress / gradient, 1, 10 * rounding);
}

}  // namespace
}  // namespace rheocyte::liquid_test
