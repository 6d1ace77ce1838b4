#include "solve/bdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace rheocyte::bdf_test {
namespace {

const std::vector<double> past = {1.0, 0.7, 0.55, 0.1, -0.3, -0.4, -1.1};  // unequal steps
constexpr double now = 1.3;

TEST(Bdf, DifferentiatesPolynomialsUpToItsOrderExactly) {
  // d(t^m)/dt at the new time for m = 0 .. order; rounding is amplified by weights near 10.
  for (int order = 1; order <= max_bdf_order; ++order) {
    const BdfFormula formula = bdf_formula(past, order, now);
    for (int m = 0; m <= order; ++m) {
      double slope = formula.rate * std::pow(now, m);
      for (int i = 0; i < order; ++i) slope += formula.weights(i) * std::pow(past[i], m);
      EXPECT_NEAR(slope, m == 0 ? 0 : m * std::pow(now, m - 1), 1e-10);
    }
  }
}

TEST(Bdf, HasTheTextbookCoefficientsForEqualSteps) {
  // Order 2: (3 y_n - 4 y_(n-1) + y_(n-2)) / (2 h).
  const std::vector<double> equal = {0, -0.1, -0.2};
  const BdfFormula formula = bdf_formula(equal, 2, 0.1);
  EXPECT_NEAR(formula.rate, 15, 1e-12);
  EXPECT_NEAR(formula.weights(0), -20, 1e-12);
  EXPECT_NEAR(formula.weights(1), 5, 1e-12);
}

TEST(Bdf, ExtrapolatesPolynomialsExactly) {
  for (int levels = 1; levels <= 6; ++levels) {
    const auto weights = extrapolation_weights(std::span(past).first(levels), now);
    for (int m = 0; m < levels; ++m) {
      double value = 0;
      for (int i = 0; i < levels; ++i) value += weights(i) * std::pow(past[i], m);
      EXPECT_NEAR(value, std::pow(now, m), 1e-9);
    }
  }
}

TEST(Bdf, TheErrorEstimateIsExactForPolynomialsOfOneDegreeMore) {
  // y' = f(t): the new value is off by what the estimate says, for y = t^(order + 1).
  for (int order = 1; order <= max_bdf_order; ++order) {
    const BdfFormula formula = bdf_formula(past, order, now);
    const auto y = [&](double t) { return std::pow(t, order + 1); };
    double value = (order + 1) * std::pow(now, order);
    for (int i = 0; i < order; ++i) value -= formula.weights(i) * y(past[i]);
    value /= formula.rate;
    const auto weights = extrapolation_weights(std::span(past).first(order + 1), now);
    double predicted = 0;
    for (int i = 0; i <= order; ++i) predicted += weights(i) * y(past[i]);
    EXPECT_NEAR(formula.error_fraction * (value - predicted), value - y(now), 1e-9);
  }
}

TEST(Bdf, TheNextStepFollowsTheError) {
  // A small error lets the step grow, a large one shrinks it; one that is about right leaves it alone.
  EXPECT_GT(choose_step(2, {-1, 1e-4, -1}).factor, 1.5);
  EXPECT_LT(choose_step(2, {-1, 0.9, -1}).factor, 1);
  EXPECT_EQ(choose_step(2, {-1, 0.5, -1}).factor, 1);
  EXPECT_EQ(choose_step(2, {1.0, 0.5, 1e-6}).order, 3);
  EXPECT_EQ(choose_step(3, {1e-3, 0.5, 1.0}).order, 2);
  EXPECT_LT(shortening(2, 8), 0.5);
  EXPECT_LT(shortening(2, std::nan("")), 0.5);
}

}  // namespace
}  // namespace rheocyte::bdf_test
