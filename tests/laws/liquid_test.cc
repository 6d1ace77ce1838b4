#include "laws/liquid.h"

#include <gtest/gtest.h>

#include "derivative_error.h"
#include "random_states.h"

namespace rheocyte {
namespace {

using test::RandomStates;
using test::states;

// Some dozen operations on stresses of order ten.
constexpr double rounding = 1e-12;
// From shear thinning stronger than any measured buffer to shear thickening.
constexpr std::array exponents = {0.4, 0.6039, 1.0, 1.5};

Liquid newtonian() { return {}; }
Liquid power_law(double n) { return {LiquidLaw::power_law, n, 0, 0}; }

std::vector<Liquid> all_liquids() {
  std::vector<Liquid> liquids = {newtonian()};
  for (const double n : exponents) liquids.push_back(power_law(n));
  liquids.push_back({LiquidLaw::power_law, 0.6, 0.1, 0});
  return liquids;
}

TEST(Liquid, TheStressHasTheDerivativeOfCentralDifferences) {
  // Dual numbers are exact for both laws, regularised or not.
  RandomStates random;
  for (const Liquid& liquid : all_liquids()) {
    const auto law = test::entrywise([&](const auto& L) { return viscous_stress(liquid, L.eval()); });
    for (int i = 0; i < states; ++i) {
      // Shear rates near zero have unbounded higher derivatives where n < 1: the differences fail there, not the law.
      const Tensor<double> L = random.tensor(1) + Tensor<double>(Eigen::Vector3d(1, 0, -1).asDiagonal());
      if ((L + L.transpose()).norm() < 0.5) continue;
      EXPECT_LT(test::derivative_error<9>(law, test::entries(L)), test::derivative_tolerance);
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
      EXPECT_GT(viscous_stress(liquid, L).cwiseProduct(L).sum(), 0);
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

double flow_rate(const Liquid& liquid) {
  constexpr int intervals = 2000;  // Simpson's rule
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

}  // namespace
}  // namespace rheocyte
