// EC50 and trend of a treatment, by recordings at several doses.
#include "population/dose_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "numeric/cell_random.h"

namespace rheocyte::dose_response_test {
namespace {

const std::vector<double> doses{0, 0.001, 0.005, 0.01, 0.025, 0.05, 0.1};

/// Sessions with levels of their own, at all doses; the law of eq:dose-response, or none if `ec50` is 0.
std::vector<MeanAtDose> drawn(double ec50, double log_effect, double scatter, std::uint64_t seed, int sessions = 3) {
  std::vector<MeanAtDose> means;
  for (int session = 0; session < sessions; ++session) {
    CellRandom level(seed, std::uint64_t(session), Purpose::place);
    const double of_session = 0.1 * level.normal();
    for (std::size_t k = 0; k < doses.size(); ++k) {
      CellRandom random(seed, std::uint64_t(session) * doses.size() + k, Purpose::population);
      const double part = ec50 > 0 ? doses[k] / (doses[k] + ec50) : 0;
      means.push_back({of_session + log_effect * part + scatter * random.normal(), doses[k], std::size_t(session)});
    }
  }
  return means;
}

TEST(DoseResponse, OfAnExactLawIsThatLaw) {
  const DoseResponse found = dose_response(drawn(0.02, -0.6, 0, 1), 0.95);
  EXPECT_NEAR(found.ec50, 0.02, 1e-4);
  EXPECT_NEAR(found.log_effect, -0.6, 2e-3);
  EXPECT_LT(found.ec50_upper / found.ec50_lower, 1.02);
  EXPECT_LT(found.slope_per_decade, 0);
  EXPECT_LT(found.p, 1e-3);
}

TEST(DoseResponse, IntervalsContainTheTruthAsOftenAsTheySay) {
  constexpr int trials = 300;
  int inside = 0, significant = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const DoseResponse found = dose_response(drawn(0.02, -0.6, 0.08, 100 + std::uint64_t(trial)), 0.95);
    inside += found.ec50_lower <= 0.02 && 0.02 <= found.ec50_upper;
    significant += dose_response(drawn(0, 0, 0.08, 1000 + std::uint64_t(trial)), 0.95).p < 0.05;
  }
  EXPECT_GE(inside, 0.91 * trials);
  EXPECT_LE(inside, 0.99 * trials);
  EXPECT_GE(significant, 0.02 * trials) << "without an effect";
  EXPECT_LE(significant, 0.08 * trials);
}

TEST(DoseResponse, AnEndThatTheDosesDoNotReachIsOpen) {
  const DoseResponse found = dose_response(drawn(5, -3, 0.02, 7), 0.95);
  EXPECT_EQ(found.ec50_upper, HUGE_VAL);
  EXPECT_GT(found.ec50_lower, 0.05);
}

TEST(DoseResponse, NeedsThreeDosesAndMoreRecordingsThanNumbers) {
  const std::vector<MeanAtDose> two{{0, 0, 0}, {-0.3, 0.1, 0}, {0.1, 0, 1}, {-0.25, 0.1, 1}};
  EXPECT_TRUE(std::isnan(dose_response(two, 0.95).ec50));
  EXPECT_TRUE(std::isnan(dose_response(two, 0.95).slope_per_decade));
  const std::vector<MeanAtDose> once{{0, 0, 0}, {-0.3, 0.1, 0}, {-0.35, 1, 0}};
  EXPECT_TRUE(std::isnan(dose_response(once, 0.95).ec50_upper));
  EXPECT_NEAR(dose_response(once, 0.95).slope_per_decade, -0.05, 1e-12);
}

}  // namespace
}  // namespace rheocyte::dose_response_test
