// The figure command refuses what it cannot make with one sentence; a checked case gives the identity of its results.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "run_program.h"

namespace rheocyte::test::figure_command_test {
namespace {

namespace fs = std::filesystem;

void expect_refusal(const std::vector<std::string>& arguments, const std::string& words) {
  std::vector<std::string> all{RHEOCYTE, "figure"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  expect_sentence(run({all}), words);
}

TEST(FigureCommand, BadArgumentsAreRefusedAndLeaveNothing) {
  const TemporaryFolder folder;
  const auto out = (folder.path() / "out").string();
  expect_refusal({}, "N is required");
  for (const std::string number : {"1", "0", "five", "5.0"}) expect_refusal({number, "-o", out}, "available are ");
  expect_refusal({"", "-o", out}, "an argument is empty");
  expect_refusal({"-5", "-o", out}, "-5");
  expect_refusal({"5", "6", "-o", out}, "6");
  expect_refusal({"5", "-o"}, "-o");
  expect_refusal({"5", "--program", "/bin/true"}, "--program");
  EXPECT_TRUE(fs::is_empty(folder.path()));
  write_file(folder.path() / "file", "precious");
  expect_refusal({"5", "-o", folder.path() / "file"}, "cannot be made");
  expect_refusal({"5", "-o", folder.path() / "file/below"}, "cannot be made");
  EXPECT_EQ(content_of(folder.path() / "file"), "precious");
}

TEST(FigureCommand, AMissingInterpreterOrPackageIsNamed) {
  const auto ended = run({.arguments = {RHEOCYTE, "figure", "5"}, .environment = {{"RHEOCYTE_PYTHON", "/nowhere"}}});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.err.find("No module named"), std::string::npos) << ended.err;
}

TEST(CheckedCase, TellsItsDefaultsAndTheHashOfItsResults) {
  const auto check = [](const std::vector<std::string>& more) {
    std::vector<std::string> all{RHEOCYTE, "solve", "--check", "--json", std::string(EXAMPLES) + "/paper-cell.toml"};
    all.insert(all.end(), more.begin(), more.end());
    const auto ended = run({all});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(ended.err, "");
    return nlohmann::json::parse(ended.out);
  };
  const auto plain = check({}), harder = check({"--set", "cell.bulk.young_modulus_kPa=9"});
  EXPECT_EQ(plain["program"], "rheocyte");
  EXPECT_TRUE(plain["case"]["numerics"].contains("accuracy"));
  EXPECT_EQ(harder["case"]["cell"]["bulk"]["young_modulus_kPa"], 9);
  EXPECT_NE(plain["case_hash"], harder["case_hash"]);
  EXPECT_EQ(plain, check({}));
}

}  // namespace
}  // namespace rheocyte::test::figure_command_test
