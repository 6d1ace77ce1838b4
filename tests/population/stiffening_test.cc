// The exponent of the modulus over the stress, by recordings at several flow rates.
#include "population/stiffening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <vector>

#include "numeric/cell_random.h"

namespace rheocyte::stiffening_test {
namespace {

const std::vector<double> stresses{100, 160, 250};
double middle_of_stresses() { return (std::log(100.) + std::log(160.) + std::log(250.)) / 3; }

/// Three recordings at each of three stresses, with a scatter of their own beyond the sampling.
std::vector<MeanAtStress> drawn(double exponent, double scatter, double sampling, std::uint64_t seed) {
  std::vector<MeanAtStress> means;
  for (std::uint64_t k = 0; k < 9; ++k) {
    CellRandom random(seed, k, Purpose::population);
    const double log_stress = std::log(stresses[k % stresses.size()]);
    const double off = scatter * random.normal() + sampling * random.normal();
    means.push_back({{1 + exponent * log_stress + off, sampling * sampling}, log_stress});
  }
  return means;
}

TEST(Stiffening, OfAnExactPowerIsThatPowerWithoutAnyWidth) {
  const Stiffening found = stiffening_of(drawn(0.3, 0, 0, 1), 0.95);
  EXPECT_NEAR(found.exponent, 0.3, 1e-12);
  EXPECT_NEAR(found.upper - found.lower, 0, 1e-6);
  EXPECT_EQ(found.freedom, 7);
  EXPECT_NEAR(found.value, 1 + 0.3 * middle_of_stresses(), 1e-12) << "at the mean of ln(stress)";
}

TEST(Stiffening, ItsIntervalsHoldTheTruthAsOftenAsTheySay) {
  constexpr int trials = 400;
  int of_exponent = 0, of_value = 0;
  for (std::uint64_t seed = 0; seed < trials; ++seed) {
    const Stiffening found = stiffening_of(drawn(0.2, 0.04, 0.02, seed), 0.9);
    of_exponent += found.lower < 0.2 && 0.2 < found.upper;
    const double value = 1 + 0.2 * middle_of_stresses();
    of_value += found.value_lower < value && value < found.value_upper;
  }
  // Binomial: a standard deviation of 1.5 %, of which four.
  EXPECT_NEAR(double(of_exponent) / trials, 0.9, 0.06);
  EXPECT_NEAR(double(of_value) / trials, 0.9, 0.06);
}

/// Three recordings that lie on a line by chance say nothing against their sampling.
TEST(Stiffening, IsNotKnownBetterThanBySampling) {
  const std::vector<MeanAtStress> means{{{1, 1e-4}, 4}, {{1.2, 1e-4}, 5}, {{1.4, 1e-4}, 6}};
  const Stiffening found = stiffening_of(means, 0.95);
  EXPECT_NEAR(found.exponent, 0.2, 1e-12);
  EXPECT_NEAR(found.upper - found.exponent, 1.959964 * std::sqrt(1e-4 / 2), 1e-8) << "two squares of distance 1";
  EXPECT_NEAR(found.value_upper - found.value, 1.959964 * std::sqrt(1e-4 / 3), 1e-8);
}

TEST(Stiffening, CountsStressesThatDiffer) {
  EXPECT_EQ(distinct_stresses({}), 0);
  const auto count = [](std::initializer_list<double> logs) {
    std::vector<MeanAtStress> means;
    for (const double log_stress : logs) means.push_back({{1, 1e-4}, log_stress});
    return distinct_stresses(means);
  };
  EXPECT_EQ(count({4, 4.02}), 1) << "2 %: temperature alone";
  EXPECT_EQ(count({4.7, 4, 4.01, 4.69}), 2);
  EXPECT_EQ(count({5, 4.4, 4, 4.01}), 3);
}

}  // namespace
}  // namespace rheocyte::stiffening_test
