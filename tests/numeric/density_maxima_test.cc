// Two populations have two maxima; one has one, whatever its skewness.
#include "numeric/density_maxima.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace rheocyte::density_maxima_test {
namespace {

/// A fraction about 0, the others about `apart`, each with a standard deviation of 1.
std::vector<double> mixture(std::mt19937& random, int count, double fraction, double apart) {
  std::normal_distribution<double> normal;
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(normal(random) + (i < fraction * count ? 0 : apart));
  return values;
}

TEST(DensityMaxima, TwoPopulationsAreSeenWithTheirPlacesAndShares) {
  std::mt19937 random(3);
  for (const double fraction : {0.3, 0.5, 0.7}) {
    const DensityMaxima m = density_maxima(mixture(random, 2000, fraction, 4.5));
    ASSERT_TRUE(m.are_two()) << fraction;
    // A maximum of a smooth density is found to some tenths of the spread.
    EXPECT_NEAR(m.lower, 0, 0.4);
    EXPECT_NEAR(m.upper, 4.5, 0.4);
    EXPECT_NEAR(m.fraction_below, fraction, 0.03);
  }
}

TEST(DensityMaxima, OnePopulationHasOneAlsoIfItIsSkewOrWide) {
  std::mt19937 random(5);
  std::exponential_distribution<double> exponential;
  std::uniform_real_distribution<double> uniform;
  int seen = 0;
  for (int k = 0; k < 200; ++k) {
    seen += density_maxima(mixture(random, 300, 1, 0)).are_two() ? 1 : 0;
    seen += density_maxima(mixture(random, 300, 0.5, 1.8)).are_two() ? 1 : 0;
    std::vector<double> skew, flat;
    for (int i = 0; i < 300; ++i) skew.push_back(exponential(random)), flat.push_back(uniform(random));
    seen += density_maxima(skew).are_two() ? 1 : 0;
    seen += density_maxima(flat).are_two() ? 1 : 0;
  }
  EXPECT_LE(seen, 4) << "of 800";
}

TEST(DensityMaxima, FewOrEqualNumbersHaveNone) {
  std::mt19937 random(7);
  EXPECT_FALSE(density_maxima(mixture(random, 99, 0.5, 6)).are_two());
  EXPECT_FALSE(density_maxima(std::vector<double>(500, 2.0)).are_two());
  EXPECT_FALSE(density_maxima({}).are_two());
}

}  // namespace
}  // namespace rheocyte::density_maxima_test
