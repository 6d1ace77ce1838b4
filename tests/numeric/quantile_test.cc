// Quantiles are those of the sorted numbers.
#include "numeric/quantile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rheocyte::quantile_test {
namespace {

double of_sorted(std::vector<double> values, double fraction) {
  std::ranges::sort(values);
  const double place = fraction * double(values.size() - 1);
  const auto below = std::size_t(place);
  return values[below] + (place - double(below)) * (values[std::min(below + 1, values.size() - 1)] - values[below]);
}

void expect_those_of_sorted(const std::vector<double>& values) {
  for (const double fraction : {0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0})
    EXPECT_EQ(quantile(values, fraction), of_sorted(values, fraction)) << values.size() << " " << fraction;
}

TEST(Quantile, IsThatOfTheSortedNumbers) {
  // Of few and many numbers, of equal ones, of a sample with one far outlier.
  std::mt19937 random(3);
  std::normal_distribution<double> normal(5, 2);
  for (const std::size_t count : {1, 2, 3, 4, 10, 101, 5000}) {
    std::vector<double> values(count), steps(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = normal(random), steps[i] = std::round(values[i]);
    expect_those_of_sorted(values);
    expect_those_of_sorted(steps);
    values.back() = -1e12;
    expect_those_of_sorted(values);
    expect_those_of_sorted(std::vector<double>(count, 0.1));
  }
}

TEST(Quantile, TheMedianOfNumbersSomeOfWhichAreInfinite) {
  // Ratios may be: the middle of three or four (the upper one) stays what it is.
  constexpr float inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(median_of(std::vector<float>{inf, 1, 2}), 2);
  EXPECT_EQ(median_of(std::vector<float>{-inf, 1, 2, 3}), 2);
  EXPECT_EQ(median_of(std::vector<float>{inf, inf, 2}), inf);
  EXPECT_TRUE(std::isnan(median_of(std::vector<double>{})));
}

}  // namespace
}  // namespace rheocyte::quantile_test
