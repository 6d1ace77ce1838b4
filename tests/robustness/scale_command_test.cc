// `rheocyte scale`: a table for other conditions, never over the user's own file; what is not exact needs a word.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "run_program.h"

namespace rheocyte::test::scale_command_test {
namespace {

namespace fs = std::filesystem;

const std::string table = R"(# BEGIN METADATA
# {"channel_width": 20.0, "channel_width_unit": "um", "flow_rate": 0.04, "flow_rate_unit": "uL/s",
#  "fluid_density": 1000.0, "fluid_viscosity": 15.0, "fluid_viscosity_unit": "mPa s", "identifier": "XX-2D-26"}
# END METADATA
#
# area_um [um^2]	deform	emodulus [kPa]
100	0.02	2
)";

class Scale : public testing::Test {
 protected:
  Scale() { write_file(input, table); }

  static Ended scale(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {RHEOCYTE, "scale"});
    return run({arguments});
  }

  void expect_refusal(const std::vector<std::string>& arguments, const std::string& words) const {
    auto all = arguments;
    all.insert(all.begin(), input);
    expect_sentence(scale(all), words);
  }

  TemporaryFolder folder;
  const std::string input = folder.path() / "lut.txt", output = folder.path() / "scaled.txt";
};

TEST_F(Scale, WritesAWholeTable) {
  const auto ended = scale({input, "--channel-width-um", "25", "-o", output});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const auto text = content_of(output);
  EXPECT_TRUE(text.starts_with("# rheocyte ")) << text;
  // 100 x 1.25^2 and 2 / 1.25^3
  EXPECT_NE(text.find("\n1.562500000e+02\t2.000000000e-02\t1.024000000e+00\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\"identifier\": \"XX-2D-26-25um-0.04uls-15mPas\""), std::string::npos) << text;
  EXPECT_EQ(scale({input, "--channel-width-um", "24", "-o", output}).exit_code, 0);  // its own files it replaces
}

TEST_F(Scale, WhatIsNotExactNeedsAWord) {
  const std::vector<std::string> fast{"--flow-rate-ul-s", "0.12", "--viscosity-mPas", "5", "-o", output};
  expect_refusal(fast, "the scaling would not be exact: inertia changes");
  EXPECT_FALSE(fs::exists(output));
  auto told = fast;
  told.insert(told.begin(), {input, "--inexact"});
  EXPECT_EQ(scale(told).exit_code, 0);
  EXPECT_NE(content_of(output).find("# Not exact: inertia changes"), std::string::npos);
}

TEST_F(Scale, TablesThatComeWithTheProgramBecomeTextsAndLines) {
  const std::string lines = folder.path() / "lines.txt";
  EXPECT_EQ(scale({"LE-2D-26", "-o", output}).exit_code, 0);
  EXPECT_EQ(scale({"LE-2D-26", "--lines", "-o", lines}).exit_code, 0);
  EXPECT_NE(content_of(output).find("\"identifier\": \"LE-2D-26\""), std::string::npos);
  EXPECT_NE(content_of(lines).find("\"lut identifier\": \"LE-2D-26\""), std::string::npos);
  EXPECT_EQ(scale({"LE-2D-26", "--channel-width-um", "30", "-o", output}).exit_code, 0);
  EXPECT_NE(content_of(output).find("\"identifier\": \"LE-2D-26-30um-0.04uls-15mPas\""), std::string::npos);
  expect_sentence(scale({"LE-2D-27", "-o", output}), "did you mean");
  expect_refusal({"--lines", "--channel-width-um", "30", "-o", output}, "--lines makes isoelasticity lines");
}

TEST_F(Scale, MistakesAreNamed) {
  expect_refusal({"-o", output}, "give at least one of");
  expect_refusal({"--channel-width-um", "nan", "-o", output}, "nan is outside its range");
  expect_refusal({"--channel-width-um", "25", "-o", input}, "is the table itself");
  expect_refusal({"--channel-width-um", "25", "-o", output, "--identifier", "a/b"}, "may contain only letters");
  write_file(output, "thesis");
  expect_refusal({"--channel-width-um", "25", "-o", output}, "was not written by rheocyte");
  EXPECT_EQ(content_of(output), "thesis");
  write_file(input, "no table");
  expect_refusal({"--channel-width-um", "25", "-o", output}, "lut.txt:1: a row before");
}

}  // namespace
}  // namespace rheocyte::test::scale_command_test
