// Which recordings a condition has its number from, and in what recordings differ that are compared.
#include "experiment/condition_reports.h"

#include <gtest/gtest.h>

#include "experiment/unlike_recordings.h"

namespace rheocyte::condition_reports_test {
namespace {

/// With ln E as a mean; recordings of one condition are sessions one after the other.
RecordingReport recording(std::size_t condition, std::size_t session, double log_modulus) {
  RecordingReport r;
  r.recording = "r" + std::to_string(condition) + std::to_string(session) + ".rtdc";
  r.condition = condition;
  r.session = session;
  r.conditions.flow = {20, 0.04, 15};
  r.median_viscosity_mPas = 15;
  r.pixel_size_um = 0.34;
  r.medium = "CellCarrier";
  r.temperature_C = 23;
  r.fitted_events = 100;
  r.log_radius = 1.8, r.radius_spread = 0.07;
  r.quantities = {{PopulationQuantity::young_modulus, {log_modulus, 1e-4}, 0.2}};
  return r;
}

RecordingReport failed(RecordingReport r, bool is_beyond) {
  r.failure = "no number";
  r.is_beyond = is_beyond;
  r.quantities.clear();
  return r;
}

RecordingReport at_rate(RecordingReport r, double rate_ul_s) {
  r.conditions.flow.rate_ul_s = rate_ul_s;
  return r;
}

const std::vector<PopulationCondition> two_conditions{{"control", {}}, {"drug", {}}};

TEST(ConditionReports, ARecordingThatCouldNotBeFittedIsLeftOutByName) {
  const std::vector<RecordingReport> recordings{recording(0, 0, 1),   failed(recording(0, 1, 1), false),
                                                recording(0, 2, 1.2), recording(1, 0, 2),
                                                recording(1, 1, 2.1), recording(1, 2, 2.3)};
  const auto reports = condition_reports(recordings, two_conditions, 0.95);
  ASSERT_TRUE(reports[0].has_numbers());
  EXPECT_EQ(reports[0].recordings, 2U);
  EXPECT_EQ(reports[0].left_out, std::vector<std::filesystem::path>{"r01.rtdc"});
  EXPECT_NEAR(reports[0].quantities.front().log_mean.value, 1.1, 1e-12);
  // The pair of its session goes, too: (2 - 1 + 2.3 - 1.2) / 2.
  const auto paired = comparisons_of(recordings, 2, {true, {}}), unpaired = comparisons_of(recordings, 2, {false, {}});
  ASSERT_EQ(paired.size(), 1U);
  EXPECT_NEAR(paired.front().difference.value, 1.05, 1e-12);
  EXPECT_EQ(paired.front().difference.freedom, 1);
  EXPECT_NEAR(unpaired.front().difference.value, (2 + 2.1 + 2.3) / 3 - 1.1, 1e-12);
}

/// Without its softest recording a condition would be that of the stiffer ones.
TEST(ConditionReports, ARecordingBeyondTheTableIsNotLeftOutButCostsTheNumber) {
  const std::vector<RecordingReport> recordings{recording(0, 0, 1), recording(1, 0, 2),
                                                failed(recording(1, 1, 0), true)};
  const auto reports = condition_reports(recordings, two_conditions, 0.95);
  EXPECT_TRUE(reports[0].has_numbers());
  EXPECT_FALSE(reports[1].has_numbers());
  EXPECT_EQ(reports[1].without_numbers_by, "r11.rtdc");
  EXPECT_TRUE(comparisons_of(recordings, 2, {false, {}}).empty());
}

TEST(ConditionReports, APowerOfTheStressNeedsThreeFlowRatesOfOneChannelAndMedium) {
  std::vector<RecordingReport> recordings{recording(0, 0, 1), recording(0, 1, 1.02),
                                          at_rate(recording(0, 2, 1.3), 0.08), at_rate(recording(0, 3, 1.33), 0.08)};
  const std::vector<PopulationCondition> one{{"a", {}}};
  const auto power = [&] { return condition_reports(recordings, one, 0.95)[0].quantities.front().stiffening; };
  EXPECT_FALSE(power()) << "two rates";
  recordings.push_back(at_rate(recording(0, 4, 1.6), 0.16));
  ASSERT_TRUE(power());
  EXPECT_NEAR(power()->exponent, 0.43, 0.02) << "0.3 for each factor of two";
  recordings.back().medium = "water";
  EXPECT_FALSE(power()) << "another liquid";
}

TEST(UnlikeRecordings, AreNamedByWhatDiffersWithNumbers) {
  const RecordingReport one = recording(0, 0, 1);
  RecordingReport warmer = one, wider = one, other = one;
  warmer.temperature_C = 25.5;
  wider.conditions.flow.width_um = 30, wider.conditions.flow.rate_ul_s = 0.16;
  other.medium = "water";
  EXPECT_EQ(differences_within({&one, &one}), "");
  EXPECT_EQ(differences_within({&one, &warmer}), "temperature (23 degC and 25.5 degC)");
  EXPECT_EQ(differences_within({&one, &wider}), "channel width (20 um and 30 um), flow rate (0.04 ul/s and 0.16 ul/s)");
  EXPECT_EQ(differences_between({&one, &other}, {&other}), "medium (CellCarrier and water)");
  EXPECT_EQ(differences_between({&one, &wider}, {&wider, &one}), "") << "conditions that have the same of each";
  EXPECT_TRUE(share_channel_and_medium({&one, &warmer}));
  EXPECT_FALSE(share_channel_and_medium({&one, &wider}));
}

/// Temperatures of a day, and liquids without a name that have one viscosity.
TEST(UnlikeRecordings, DoNotDifferByLittle) {
  RecordingReport one = recording(0, 0, 1), other = one;
  other.temperature_C = 23.4;
  other.median_viscosity_mPas = 14.8;
  EXPECT_EQ(differences_within({&one, &other}), "");
  one.medium = other.medium = "";
  EXPECT_EQ(differences_within({&one, &other}), "") << "1.3 %";
  other.median_viscosity_mPas = 7;
  EXPECT_EQ(differences_within({&one, &other}), "medium (15 mPa s and 7 mPa s)");
}

}  // namespace
}  // namespace rheocyte::condition_reports_test
