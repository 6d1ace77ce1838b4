// The exponent of the modulus over the stress, by recordings at several flow rates.
#include "population/stiffening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "numeric/cell_random.h"

namespace rheocyte::stiffening_test {
namespace {

/// Four recordings at each of two stresses, with a scatter of their own beyond the sampling.
std::vector<MeanAtStress> drawn(double exponent, double scatter, double sampling, std::uint64_t seed) {
  std::vector<MeanAtStress> means;
  for (std::uint64_t k = 0; k < 8; ++k) {
    CellRandom random(seed, k, Purpose::population);
    const double log_stress = k % 2 == 0 ? std::log(100.) : std::log(250.);
    const double off = scatter * random.normal() + sampling * random.normal();
    means.push_back({{1 + exponent * log_stress + off, sampling * sampling}, log_stress});
  }
  return means;
}

TEST(Stiffening, OfAnExactPowerIsThatPowerWithoutAnyWidth) {
  const Stiffening found = stiffening_of(drawn(0.3, 0, 0, 1), 0.95);
  EXPECT_NEAR(found.exponent, 0.3, 1e-12);
  EXPECT_NEAR(found.upper - found.lower, 0, 1e-6);
  EXPECT_EQ(found.freedom, 6);
  EXPECT_NEAR(found.value, 1 + 0.3 * std::log(std::sqrt(100. * 250.)), 1e-12) << "at the mean of ln(stress)";
}

TEST(Stiffening, ItsIntervalsHoldTheTruthAsOftenAsTheySay) {
  constexpr int trials = 400;
  int of_exponent = 0, of_value = 0;
  for (std::uint64_t seed = 0; seed < trials; ++seed) {
    const Stiffening found = stiffening_of(drawn(0.2, 0.04, 0.02, seed), 0.9);
    of_exponent += found.lower < 0.2 && 0.2 < found.upper;
    const double value = 1 + 0.2 * std::log(std::sqrt(100. * 250.));
    of_value += found.value_lower < value && value < found.value_upper;
  }
  // Binomial: a standard deviation of 1.5 %, of which four.
  EXPECT_NEAR(double(of_exponent) / trials, 0.9, 0.06);
  EXPECT_NEAR(double(of_value) / trials, 0.9, 0.06);
}

TEST(Stiffening, OfTwoRecordingsThereIsTheSamplingAlone) {
  const std::vector<MeanAtStress> means{{{1, 1e-4}, 4}, {{1.2, 1e-4}, 5}};
  ASSERT_TRUE(differ_in_stress(means));
  const Stiffening found = stiffening_of(means, 0.95);
  EXPECT_NEAR(found.exponent, 0.2, 1e-12);
  EXPECT_FALSE(found.has_scatter());
  EXPECT_TRUE(std::isnan(found.lower));
  EXPECT_NEAR(found.sampling_upper - found.exponent, 1.96 * std::sqrt(2e-4), 1e-4);
}

TEST(Stiffening, NeedsStressesThatDiffer) {
  const std::vector<MeanAtStress> means{{{1, 1e-4}, 4}, {{1.2, 1e-4}, 4.02}};
  EXPECT_FALSE(differ_in_stress(means)) << "2 %: temperature alone";
  EXPECT_FALSE(differ_in_stress({}));
}

}  // namespace
}  // namespace rheocyte::stiffening_test
