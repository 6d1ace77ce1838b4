// Differences between conditions by their recordings, and the power of such tests.
#include "population/comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "numeric/cell_random.h"
#include "population/power.h"

namespace rheocyte::comparison_test {
namespace {

/// Student's sleep data (1908), as in R's data set `sleep`.
std::vector<RecordingMean> sleep(bool second) {
  const std::vector<double> first{0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0},
      other{1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};
  std::vector<RecordingMean> means;
  for (const double value : second ? other : first) means.push_back({value, 0.01});
  return means;
}

TEST(Comparison, IsStudentsPairedTestOnHisOwnData) {
  // R 4.2: t.test(extra ~ group, data = sleep, paired = TRUE): t = -4.0621, df = 9, p = 0.002833, 0.7001 .. 2.4599.
  const auto d = paired_difference(sleep(false), sleep(true), {});
  EXPECT_NEAR(d.value / d.standard_error, 4.0621, 1e-4);
  EXPECT_EQ(d.freedom, 9);
  EXPECT_NEAR(d.p, 0.002833, 1e-6);
  EXPECT_NEAR(d.lower, 0.7001142, 1e-6);
  EXPECT_NEAR(d.upper, 2.4598858, 1e-6);
  EXPECT_NEAR(d.sampling_error, std::sqrt(0.02 / 10), 1e-12);
}

TEST(Comparison, IsWelchsTestWithoutPairs) {
  // R 4.2: t.test(extra ~ group, data = sleep): t = -1.8608, df = 17.776, p = 0.07939, -0.2054832 .. 3.3654832.
  const auto d = unpaired_difference(sleep(false), sleep(true), {});
  EXPECT_NEAR(d.value / d.standard_error, 1.8608, 1e-4);
  EXPECT_NEAR(d.freedom, 17.776, 1e-3);
  EXPECT_NEAR(d.p, 0.07939, 1e-5);
  EXPECT_NEAR(d.lower, -0.2054832, 1e-6);
  EXPECT_NEAR(d.upper, 3.3654832, 1e-6);
}

TEST(Comparison, OneRecordingEachHasNoPButASamplingInterval) {
  const std::vector<RecordingMean> a{{0.5, 0.0004}}, b{{0.6, 0.0005}};
  for (const auto& d : {paired_difference(a, b, {}), unpaired_difference(a, b, {})}) {
    EXPECT_TRUE(std::isnan(d.p) && std::isnan(d.lower));
    EXPECT_NEAR(d.sampling_upper - d.value, 1.959964 * 0.03, 1e-6);
    EXPECT_TRUE(std::isnan(d.known_p)) << "nothing is known of the scatter";
  }
}

TEST(Comparison, AKnownScatterOfRecordingsGivesTheNormalTest) {
  const std::vector<RecordingMean> a{{0.5, 0.0004}}, b{{0.6, 0.0005}};
  const auto d = paired_difference(a, b, {.level = 0.95, .between_recordings = 0.02});
  const double error = std::sqrt(0.0009 + 2 * 0.0004);
  EXPECT_NEAR(d.known_upper - d.value, 1.959964 * error, 1e-6);
  EXPECT_NEAR(d.known_p, std::erfc(0.1 / error / std::sqrt(2.0)), 1e-9);
}

TEST(Comparison, RejectsATrueNullOfThreePairsInFivePercent) {
  constexpr int experiments = 40000;
  int rejected = 0;
  for (int k = 0; k < experiments; ++k) {
    CellRandom random(1, std::uint64_t(k), Purpose::population);
    std::vector<RecordingMean> control, treated;
    for (int session = 0; session < 3; ++session) {
      const double of_session = 0.1 * random.normal();
      control.push_back({of_session + 0.03 * random.normal(), 1e-4});
      treated.push_back({of_session + 0.03 * random.normal(), 1e-4});
    }
    rejected += paired_difference(control, treated, {}).p < 0.05;
  }
  // Four standard deviations of 40,000 experiments: 0.44 %.
  EXPECT_NEAR(double(rejected) / experiments, 0.05, 0.0044);
}

/// Recordings of a condition with these standard deviations by sampling and between them, about 0.
std::vector<RecordingMean> drawn_condition(int recordings, double sampling, double between, CellRandom& random) {
  std::vector<RecordingMean> means;
  for (int j = 0; j < recordings; ++j)
    means.push_back({between * random.normal() + sampling * random.normal(), sampling * sampling});
  return means;
}

/// Recordings that agree by chance say nothing against their sampling; those that scatter keep Student's size. By
/// integration over the scatter an interval at 95 % covers 99.3, 98.7, 98.3 % of two, three, four recordings that
/// scatter by sampling alone, and falls to 95 % as they scatter more.
TEST(Comparison, IntervalsAreNeverNarrowerThanSamplingAndCoverTheTruth) {
  constexpr int experiments = 8000;
  for (const int recordings : {2, 3, 4})
    for (const double between : {0.0, 1.0, 4.0}) {
      int of_condition = 0, of_difference = 0, rejected = 0;
      for (int k = 0; k < experiments; ++k) {
        CellRandom random(4, std::uint64_t(k), Purpose::population);
        const auto control = drawn_condition(recordings, 1, between, random),
                   treated = drawn_condition(recordings, 1, between, random);
        const std::vector<RecordingMean> zero(control.size(), {0, 0});
        const auto mean = paired_difference(zero, control, {}), d = unpaired_difference(control, treated, {});
        for (const auto& each : {mean, d}) {
          ASSERT_LE(each.lower, each.sampling_lower);
          ASSERT_GE(each.upper, each.sampling_upper);
        }
        of_condition += mean.lower < 0 && 0 < mean.upper;
        of_difference += d.lower < 0 && 0 < d.upper;
        rejected += d.p < 0.05;
      }
      // Four standard deviations of 8,000 experiments: 1 %. Welch's test of two recordings is itself conservative.
      EXPECT_GT(double(of_condition) / experiments, 0.94) << recordings << ' ' << between;
      EXPECT_LT(double(of_condition) / experiments, 0.995) << recordings << ' ' << between;
      EXPECT_GT(double(of_difference) / experiments, 0.94) << recordings << ' ' << between;
      EXPECT_LE(rejected, experiments - of_difference) << "p agrees with the interval, or is the greater of both tests";
    }
}

TEST(Comparison, SaysWhichOfBothIntervalsItGives) {
  const std::vector<RecordingMean> zero{{0, 0}, {0, 0}}, alike{{0.5, 0.01}, {0.5001, 0.01}},
      apart{{0, 0.01}, {1, 0.01}};
  const auto by_sampling = paired_difference(zero, alike, {}), by_recordings = paired_difference(zero, apart, {});
  EXPECT_TRUE(by_sampling.is_by_sampling);
  EXPECT_NEAR(by_sampling.upper - by_sampling.value, 1.959964 * 0.1 / std::sqrt(2.0), 1e-6);
  // The mean over its scatter is 10001: with one degree of freedom the less certain of both.
  EXPECT_NEAR(by_sampling.p, 2 / (std::numbers::pi * 10001), 1e-9);
  EXPECT_FALSE(by_recordings.is_by_sampling);
  EXPECT_NEAR(by_recordings.upper - by_recordings.value, 12.7062 * 0.5, 1e-4) << "Student's t, one degree of freedom";
}

TEST(ScatterBetween, IsFoundBehindTheSamplingErrors) {
  std::vector<RecordingMean> means;
  CellRandom random(2, 0, Purpose::population);
  for (int k = 0; k < 400; ++k) {
    const double sampling = 0.01 + 0.02 * random.uniform();
    means.push_back({0.05 * random.normal() + sampling * random.normal(), sampling * sampling});
  }
  const auto scatter = scatter_between(means, 0.95);
  EXPECT_NEAR(scatter.deviation, 0.05, 0.008);  // four standard errors of 400
  EXPECT_LT(scatter.lower, scatter.deviation);
  EXPECT_GT(scatter.upper, scatter.deviation);
  EXPECT_LT(scatter.upper - scatter.lower, 0.012);
}

TEST(ScatterBetween, OfRecordingsThatAgreeIsZeroWithAnUpperEnd) {
  const std::vector<RecordingMean> means{{1, 0.01}, {1.001, 0.01}, {0.999, 0.01}};
  const auto scatter = scatter_between(means, 0.95);
  EXPECT_EQ(scatter.deviation, 0);
  EXPECT_EQ(scatter.lower, 0);
  EXPECT_TRUE(std::isnan(scatter_between({means.data(), 1}, 0.95).deviation));
}

TEST(Power, IsTheFractionOfSimulatedExperimentsThatAreSignificant) {
  const Experiment experiment{500, 0.2, 0.1, 0.04};
  for (const int sessions : {3, 5}) {
    constexpr int experiments = 20000;
    int found = 0;
    for (int k = 0; k < experiments; ++k) {
      CellRandom random(3, std::uint64_t(k), Purpose::population);
      std::vector<RecordingMean> control, treated;
      for (int j = 0; j < sessions; ++j) {
        const auto mean = [&] { return 0.04 * random.normal() + std::sqrt((0.04 + 0.01) / 500) * random.normal(); };
        control.push_back({mean(), 1e-4});
        treated.push_back({std::log(1.1) + mean(), 1e-4});
      }
      found += paired_difference(control, treated, {}).p < 0.05;
    }
    EXPECT_NEAR(power_of(experiment, sessions, std::log(1.1)), double(found) / experiments, 0.015) << sessions;
  }
}

TEST(Power, GrowsWithSessionsAndHasNoneOfOne) {
  const Experiment experiment{500, 0.2, 0.08, 0.04};
  EXPECT_EQ(power_of(experiment, 1, 0.1), 0);
  EXPECT_NEAR(power_of(experiment, 3, 0), 0.05, 1e-6) << "without a difference it is the size";
  EXPECT_EQ(power_of(experiment, 20, 3), 1);
  const int sessions = sessions_for(experiment, std::log(1.1), 0.8);
  EXPECT_GE(power_of(experiment, sessions, std::log(1.1)), 0.8);
  EXPECT_LT(power_of(experiment, sessions - 1, std::log(1.1)), 0.8);
  EXPECT_EQ(sessions_for(experiment, 1e-4, 0.8), 0);
}

}  // namespace
}  // namespace rheocyte::comparison_test
