// What a step leaves as an error follows from the levels that it is made from.
#include "solve/local_errors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solve/bdf.h"

namespace rheocyte::local_errors_test {
namespace {

constexpr double rounding = 1e-12;

/// Levels of uneven steps of an order from `count` exact values, the last one by the formula from its exact slope.
std::vector<TimePoint> levels_of_power(int power, int order, int count) {
  const auto time = [](int i) { return 0.3 * i + 0.02 * i * i; };
  std::vector<TimePoint> levels;
  for (int i = 0; i < count; ++i) {
    TimePoint& level = levels.emplace_back();
    level.time = time(i);
    level.order = order;
    level.state.cell_velocity = std::pow(level.time, power);
  }
  TimePoint& last = levels.emplace_back();
  last.time = time(count);
  last.order = order;
  std::vector<double> past;
  for (int i = 1; i <= order; ++i) past.push_back(time(count - i));
  const BdfFormula formula = bdf_formula(past, order, last.time);
  double history = 0;
  for (int i = 0; i < order; ++i) history += formula.weights(i) * std::pow(past[std::size_t(i)], power);
  last.state.cell_velocity = (power * std::pow(last.time, power - 1) - history) / formula.rate;
  return levels;
}

TEST(LocalErrors, AreThoseOfTheFormulaWhereOneDerivativeIsLeftOut) {
  // A power of one more than the order, exactly; of those up to the order nothing is left.
  for (int order = 1; order <= max_bdf_order; ++order) {
    SCOPED_TRACE(order);
    for (const int power : {order, order + 1}) {
      const std::vector<TimePoint> levels = levels_of_power(power, order, order + 1);
      const TimePoint& last = levels.back();
      const double left = std::abs(last.state.cell_velocity - std::pow(last.time, power));
      EXPECT_NEAR(local_errors(levels).numbers.back().cell_velocity, left, rounding);
      EXPECT_EQ(left > 1e3 * rounding, power > order);
    }
  }
}

TEST(LocalErrors, OfAPlaceAreSumsWhichContainTheVelocityThatWasExtrapolated) {
  // Equal steps h of order 1, x = t^2 and v = 2 t. The first one goes on at the velocity of the start and leaves its
  // change, 2 h, over the rate; later ones leave a third of 2 h^2, and nothing by the velocity, which is linear.
  constexpr double h = 0.5;
  std::vector<TimePoint> levels(4);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    levels[i].time = h * double(i);
    levels[i].order = 1;
    levels[i].position = levels[i].time * levels[i].time;
    levels[i].state.cell_velocity = 2 * levels[i].time;
  }
  const LocalErrors errors = local_errors(levels);
  ASSERT_EQ(errors.positions.size(), levels.size());
  EXPECT_EQ(errors.positions[0], 0);
  for (std::size_t i = 1; i < levels.size(); ++i)
    EXPECT_NEAR(errors.positions[i], h * h * (2 + 2.0 / 3 * double(i - 1)), rounding);
}

TEST(LocalErrors, OfNumbersThatAreNotKnownAreNothing) {
  std::vector<TimePoint> levels(3);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    levels[i].time = double(i);
    levels[i].order = 1;
  }
  levels[2].state.cell_velocity = 1;  // known since then
  for (const StateNumbers& numbers : local_errors(levels).numbers) {
    EXPECT_EQ(numbers.cell_velocity, 0);
    EXPECT_EQ(numbers.pressure_drop, 0);
  }
}

}  // namespace
}  // namespace rheocyte::local_errors_test
