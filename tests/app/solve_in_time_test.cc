// `rheocyte solve` of a case with a [time] section: its folder, its restart, its refusals.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "../robustness/run_program.h"

namespace rheocyte::test {
namespace {

namespace fs = std::filesystem;

class InTime : public testing::Test {
 protected:
  fs::path at(const std::string& name) const { return folder_.path() / name; }

  Command solve(const std::string& name, const std::vector<std::string>& more = {}) const {
    Command command{{RHEOCYTE, "solve", std::string(EXAMPLES) + "/paper-cell-in-time.toml", "-o", at(name),
                     "--no-picture", "--quiet", "--set", "time.degree=3", "--set", "time.output_every_us=5"}};
    command.arguments.insert(command.arguments.end(), more.begin(), more.end());
    return command;
  }
  std::string text(const std::string& name) const { return content_of(folder_.path() / name); }

  TemporaryFolder folder_;
};

TEST_F(InTime, WritesEveryFile) {
  const auto ended = run(solve("result", {"--set", "time.end_us=12"}));
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  for (const auto* file : {"result.json", "contour.csv", "fields.vtu", "case.toml", "history.csv", "contours.csv",
                           "fields.pvd", "checkpoint-1.bin"})
    EXPECT_TRUE(fs::exists(at("result") / file)) << file;
  // Outputs at 0, 5, 10 us and the end.
  EXPECT_EQ(std::distance(fs::directory_iterator(at("result") / "fields"), {}), 4);
  const auto numbers = nlohmann::json::parse(text("result/result.json"));
  EXPECT_EQ(numbers["status"], "converged");
  EXPECT_DOUBLE_EQ(numbers["time"]["t_us"], 12);
  EXPECT_LT(numbers["time"]["greatest_relative_volume_change"], 1e-6);
}

TEST_F(InTime, ARestartContinuesToTheBit) {
  // The second part begins where the first one ended and repeats none of its rows, whichever folder it is written to; a
  // run that has arrived stays as it is. (tests/solve: a resumed state takes the same steps, bit by bit.)
  ASSERT_EQ(run(solve("first", {"--set", "time.end_us=20"})).exit_code, 0);
  ASSERT_EQ(run(solve("second", {"--set", "time.end_us=60", "--continue", at("first")})).exit_code, 0);
  ASSERT_EQ(run(solve("third", {"--set", "time.end_us=60", "--continue", at("second")})).exit_code, 0);
  EXPECT_EQ(text("second/history.csv"), text("third/history.csv"));
  EXPECT_EQ(text("second/contours.csv"), text("third/contours.csv"));
  EXPECT_TRUE(text("second/history.csv").starts_with(text("first/history.csv")));
  EXPECT_TRUE(text("second/contours.csv").starts_with(text("first/contours.csv")));
  ASSERT_EQ(run(solve("first", {"--set", "time.end_us=60", "--continue", at("first")})).exit_code, 0);  // in place
  EXPECT_EQ(text("first/history.csv"), text("second/history.csv"));
}

TEST_F(InTime, RefusesWhatCannotBeContinued) {
  ASSERT_EQ(run(solve("first", {"--set", "time.end_us=5"})).exit_code, 0);
  const auto refused = [&](const std::vector<std::string>& more, const std::string& why) {
    const auto ended = run(solve("second", more));
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_NE(ended.err.find(why), std::string::npos) << ended.err;
    EXPECT_FALSE(fs::exists(at("second")));
  };
  refused({"--continue", at("first"), "--set", "cell.radius_um=6"}, "another case");
  refused({"--continue", at("first"), "--set", "time.end_us=2"}, "lies before it");
  refused({"--continue", at("nowhere")}, "holds no checkpoint");
  const auto stationary = run(
      {{RHEOCYTE, "solve", std::string(EXAMPLES) + "/paper-cell.toml", "-o", at("second"), "--continue", at("first")}});
  EXPECT_EQ(stationary.exit_code, 2);
  EXPECT_NE(stationary.err.find("--continue is for a case with a [time] section"), std::string::npos) << stationary.err;
}

}  // namespace
}  // namespace rheocyte::test
