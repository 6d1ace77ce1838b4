// Dual numbers against closed forms of the derivatives.
#include "laws/dual.h"

#include <gtest/gtest.h>

#include "laws/derivative.h"
#include "random_states.h"

namespace rheocyte::dual_test {
namespace {

using test::RandomStates;
using test::states;

constexpr double rounding = 1e-12;

template <class Function>
void expect_slopes(const Function& f, double x, double y, double value, double by_x, double by_y) {
  const auto [found, slopes] = value_and_slopes(f, std::array{x, y});
  EXPECT_NEAR(found, value, rounding);
  EXPECT_NEAR(slopes[0], by_x, rounding);
  EXPECT_NEAR(slopes[1], by_y, rounding);
}

TEST(Dual, EveryOperationHasItsDerivative) {
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const double x = random.number(0.5, 2), y = random.number(0.5, 2), s = random.number(-2, 2), r2 = x * x + y * y;
    expect_slopes([](const auto& v) { return v[0] + v[1]; }, x, y, x + y, 1, 1);
    expect_slopes([](const auto& v) { return v[0] - v[1]; }, x, y, x - y, 1, -1);
    expect_slopes([](const auto& v) { return -v[0]; }, x, y, -x, -1, 0);
    expect_slopes([](const auto& v) { return v[0] * v[1]; }, x, y, x * y, y, x);
    expect_slopes([](const auto& v) { return v[0] / v[1]; }, x, y, x / y, 1 / y, -x / (y * y));
    expect_slopes([&](const auto& v) { return (v[0] + s) * s - s; }, x, y, (x + s) * s - s, s, 0);
    expect_slopes([&](const auto& v) { return s - s * v[1] / 4.0; }, x, y, s - s * y / 4, 0, -s / 4);
    expect_slopes([&](const auto& v) { return s + s / v[1]; }, x, y, s + s / y, 0, -s / (y * y));
    expect_slopes([](const auto& v) { return sqrt(v[0]); }, x, y, std::sqrt(x), 0.5 / std::sqrt(x), 0);
    expect_slopes([](const auto& v) { return exp(v[1]); }, x, y, std::exp(y), 0, std::exp(y));
    expect_slopes([](const auto& v) { return log(v[1]); }, x, y, std::log(y), 0, 1 / y);
    expect_slopes([](const auto& v) { return pow(v[0], -0.4); }, x, y, std::pow(x, -0.4), -0.4 * std::pow(x, -1.4), 0);
    expect_slopes([](const auto& v) { return atan2(v[1], v[0]); }, x, y, std::atan2(y, x), -y / r2, x / r2);
  }
}

TEST(Dual, DualNumbersOfDualNumbersHaveSecondDerivatives) {
  // f = x^2 y: f_xx = 2 y, f_xy = 2 x, f_yy = 0.
  const auto f = [](const auto& v) { return v[0] * v[0] * v[1]; };
  const double x = 1.3, y = 0.7;
  const auto slopes = value_and_slopes(f, independent(std::array{x, y})).second;
  EXPECT_NEAR(slopes[0].value, 2 * x * y, rounding);
  EXPECT_NEAR(slopes[0].slope(0), 2 * y, rounding);
  EXPECT_NEAR(slopes[0].slope(1), 2 * x, rounding);
  EXPECT_NEAR(slopes[1].slope(0), 2 * x, rounding);
  EXPECT_NEAR(slopes[1].slope(1), 0, rounding);
}

TEST(Dual, TheExponentialOfDualNumbersHasSecondDerivatives) {
  // f = exp(x y): f_xx = y^2 f, f_xy = (1 + x y) f.
  const auto f = [](const auto& v) { return exp(v[0] * v[1]); };
  const double x = 1.3, y = 0.7;
  const auto slopes = value_and_slopes(f, independent(std::array{x, y})).second;
  EXPECT_NEAR(slopes[0].slope(0), y * y * std::exp(x * y), rounding);
  EXPECT_NEAR(slopes[0].slope(1), (1 + x * y) * std::exp(x * y), rounding);
}

TEST(Dual, EachOfManyDerivativesIsItsOwn) {
  // Of 1 to 9 numbers, which fill their packs of four more or less.
  const auto check = [](const auto& values) {
    const auto sum = [](const auto& v) {
      auto total = v[0];
      for (std::size_t i = 1; i < v.size(); ++i) total += v[i] * double(i + 1);
      return total;
    };
    const auto slopes = value_and_slopes(sum, values).second;
    for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(slopes[i], double(i + 1));
  };
  check(std::array{1.0});
  check(std::array{1.0, 2.0, 3.0, 4.0});
  check(std::array{1.0, 2.0, 3.0, 4.0, 5.0});
  check(std::array{1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0});
}

}  // namespace
}  // namespace rheocyte::dual_test
