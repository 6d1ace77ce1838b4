// `rheocyte plan`: which channel, how many sessions, and what to do where no channel shows the cells.
#include "population_fixture.h"

namespace rheocyte::test::plan_test {
namespace {

class Plan : public population_test::PopulationCommand {
 protected:
  Ended plan(double radius_um, double modulus_kPa, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"plan", "--radius-um", fmt::format("{}", radius_um), "--young-modulus-kPa",
                                   fmt::format("{}", modulus_kPa)};
    words.insert(words.end(), more.begin(), more.end());
    return call(words);
  }
};

TEST_F(Plan, NamesAChannelTheSessionsAndWhatLimits) {
  const Ended ended = call({"plan", "--radius-um", "6.5", "--young-modulus-kPa", "2", "--width-um", "20,30", "--medium",
                            "0.49% MC-PBS", "--rate-ul-s", "0.04,0.12"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_TRUE(ended.out.starts_with("channel_width_um\tmedium\tflow_rate_ul_per_s\t")) << ended.out;
  EXPECT_NE(ended.out.find("paired t test"), std::string::npos);
  EXPECT_NE(ended.out.find("it is limited by the scatter between recordings"), std::string::npos) << ended.out;
  expect_sentence(call({"plan", "--radius-um", "6.5", "--young-modulus-kPa", "2", "--medium", "honey"}),
                  "--medium honey has no known viscosity; it can be CellCarrier");
  EXPECT_NE(
      call({"plan", "--radius-um", "6.5", "--young-modulus-kPa", "2", "--difference", "0.001"}).out.find("\tinf\n"),
      std::string::npos);
  expect_sentence(call({"plan", "--radius-um", "60", "--young-modulus-kPa", "2"}), "no channel of these has cells");
  expect_sentence(call({"plan", "--radius-um", "6", "--young-modulus-kPa", "2", "--difference", "0"}),
                  "cannot be found");
}

TEST_F(Plan, ReplacesATableOfTheVersionBeforeAndRefusesOtherFiles) {
  const std::vector<std::string> to_file{"--width-um", "20", "--rate-ul-s", "0.04", "-o", "plan.tsv"};
  write_file(folder_.path() / "plan.tsv", "width_um\tmedium\trate_ul_per_s\tspeed_m_per_s\n");
  EXPECT_EQ(plan(6.5, 2, to_file).exit_code, 0);
  EXPECT_TRUE(content_of(folder_.path() / "plan.tsv").starts_with("channel_width_um\t"));
  write_file(folder_.path() / "plan.tsv", "notes\n");
  EXPECT_EQ(plan(6.5, 2, to_file).exit_code, 2);
  expect_sentence(plan(0.01, 2), "--radius-um 0.01 is outside its range 0.1 .. 1000 um");
}

/// None of them is as it should be: of d = 0.0194 with 90.5 % inside and d = 0.0417 with 63 % the first is nearer.
TEST_F(Plan, NamesTheNearestChannelWhereNoneIsRecommended) {
  const Ended ended = plan(13, 2);
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto at = ended.out.find("best of these, but d should be 0.01 to 0.03");
  ASSERT_NE(at, std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("d 0.02", at), std::string::npos) << ended.out.substr(at);
  EXPECT_NE(ended.out.find("91 % of the cells inside the table; a wider channel", at), std::string::npos)
      << ended.out.substr(at);
}

TEST_F(Plan, RefusesCellsThatNoChannelShowsAndNamesTheStressThatDoes) {
  const Ended refused = plan(6.5, 200, {"--width-um", "20"});
  expect_sentence(refused, "are too stiff to be seen in these channels");
  EXPECT_NE(refused.err.find("1.2 times the stress at the wall does"), std::string::npos) << refused.err;
  // The remedy works: the same cells in a channel of 15 um.
  const Ended narrower = plan(6.5, 200, {"--width-um", "15"});
  EXPECT_EQ(narrower.exit_code, 0) << narrower.err;
  EXPECT_EQ(narrower.out.find("inf"), std::string::npos) << narrower.out;
  EXPECT_NE(narrower.out.find("a narrower channel, a higher flow rate or a more viscous medium"), std::string::npos)
      << narrower.out;
}

TEST_F(Plan, WritesDifferencesAsPerCentAndSaysHowTheyAreGiven) {
  EXPECT_NE(plan(6.5, 2, {"--difference", "20"})
                .out.find("a difference of 2000 % (an E that is 21 times as large; --difference 0.2 is 20 %)"),
            std::string::npos);
  EXPECT_NE(plan(6.5, 2, {"--difference", "0.15"}).out.find("a difference of 15 % is found"), std::string::npos);
}

TEST_F(Plan, DoesNotRecommendFlowsWithInertia) {
  const Ended ended = plan(6.5, 6, {"--width-um", "20", "--medium", "water", "--rate-ul-s", "0.04,0.16"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find("1 of these channels have Reynolds numbers above 3"), std::string::npos) << ended.out;
}

}  // namespace
}  // namespace rheocyte::test::plan_test
