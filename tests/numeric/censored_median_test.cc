// The median of all numbers, not of those that are known.
#include "numeric/censored_median.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "numeric/quantile.h"

namespace rheocyte::censored_median_test {
namespace {

/// Lognormal numbers about 1 with a spread of 0.3, as moduli of cells.
std::vector<double> sample(std::mt19937& random, int count) {
  std::normal_distribution<double> normal;
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(std::exp(0.3 * normal(random)));
  return values;
}

/// What is left of it in a window, and what lies beside that.
CensoredMedian seen_between(const std::vector<double>& values, double low, double high) {
  std::vector<double> known;
  CensoredCounts counts;
  for (const double v : values) {
    if (v < low)
      ++counts.below;
    else if (v > high)
      ++counts.above;
    else
      known.push_back(v);
  }
  return censored_median(known, counts);
}

TEST(CensoredMedian, WithoutUnknownNumbersIsTheMedianWithItsError) {
  std::mt19937 random(5);
  for (const int count : {20, 21, 400}) {
    const auto values = sample(random, count);
    const CensoredMedian m = censored_median(values, {});
    const CountedSample<double> counted(values);
    EXPECT_EQ(m.place, MedianPlace::inside);
    EXPECT_NEAR(m.value, counted.quantile(0.5), 1e-12);
    // The quartiles of the normal distribution lie at 0.6745, here to four figures.
    EXPECT_NEAR(m.error, error_of_median(counted), 5e-4 * m.error);
    EXPECT_NEAR(m.half_range, 0, 1e-12);
  }
}

TEST(CensoredMedian, StaysWhereItIsWhenNumbersBeyondItAreNotKnown) {
  std::mt19937 random(7);
  const auto values = sample(random, 1001);
  const double whole = quantile(values, 0.5);
  constexpr double rounding = 1e-12;
  EXPECT_NEAR(seen_between(values, 0.9, 10).value, whole, rounding);
  EXPECT_NEAR(seen_between(values, 0, 1.1).value, whole, rounding);
  EXPECT_NEAR(seen_between(values, 0.8, 1.3).value, whole, rounding);
}

TEST(CensoredMedian, ItsErrorIsItsScatterAlsoWhereFortyPercentAreNotKnown) {
  std::mt19937 random(11);
  for (const double low : {0.0, 0.93}) {  // 0 and 40 % below
    int within = 0, all = 0;
    double sum = 0;
    for (int k = 0; k < 400; ++k) {
      const CensoredMedian m = seen_between(sample(random, 300), low, 100);
      if (m.place != MedianPlace::inside) continue;
      ++all;
      sum += (m.value - 1) / m.error;
      within += std::abs(m.value - 1) < m.error ? 1 : 0;
    }
    EXPECT_GT(all, 360);
    EXPECT_NEAR(sum / all, 0, 0.2);  // four standard errors of a mean of 400
    EXPECT_NEAR(double(within) / all, 0.68, 0.1);
  }
}

TEST(CensoredMedian, WithFewerThanHalfOfTheNumbersThereIsABoundThatHolds) {
  std::mt19937 random(13);
  for (int k = 0; k < 100; ++k) {
    const auto values = sample(random, 300);
    const CensoredMedian soft = seen_between(values, 1.1, 100), stiff = seen_between(values, 0, 0.92);
    EXPECT_EQ(soft.place, MedianPlace::below);
    EXPECT_EQ(stiff.place, MedianPlace::above);
    EXPECT_TRUE(std::isnan(soft.value) && std::isnan(stiff.error));
    EXPECT_FALSE(soft.bound < 1);  // NaN where none of the known numbers is one
    EXPECT_FALSE(stiff.bound > 1);
  }
  EXPECT_EQ(censored_median({}, {.below = 9, .above = 1}).place, MedianPlace::below);
  EXPECT_EQ(censored_median({}, {.below = 5, .above = 5}).place, MedianPlace::undetermined);
  EXPECT_EQ(censored_median({}, {}).place, MedianPlace::undetermined);
}

TEST(CensoredMedian, NumbersThatMayBeAnywhereWidenIt) {
  std::mt19937 random(17);
  const auto values = sample(random, 1000);
  const CensoredMedian m = censored_median(values, {.anywhere = 100});
  EXPECT_EQ(m.place, MedianPlace::inside);
  EXPECT_NEAR(m.half_range, (quantile(values, 0.55) - quantile(values, 0.45)) / 2, 1e-3);
  EXPECT_EQ(censored_median(values, {.anywhere = 1100}).place, MedianPlace::undetermined);
}

}  // namespace
}  // namespace rheocyte::censored_median_test
