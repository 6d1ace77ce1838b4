// A table of events as text gives the numbers of the recording that it was written from, to the last digit.
#include <fstream>

#include "extract_fixture.h"

namespace rheocyte::text_recording_test {
namespace {

using test::column;
using test::RecordingWriter;

class TextRecording : public test::ExtractFixture {
 protected:
  static constexpr const char* set_up =
      "# setup:channel width = 20\n# setup:flow rate = 0.04\n# setup:chip region = channel\n"
      "# setup:medium = CellCarrier\n# setup:temperature = 23\n# imaging:pixel size = 0.34\n";
  static constexpr const char* events =
      "area_um,deform,inert_ratio_cvx,time\n80,0.03,1.05,0\n10,0.03,1.05,1\n400,0.03,1.05,2\n80,-0.01,1.05,3\n80,0.5,1."
      "05,4\n"
      "80,,1.05,5\n77.123456789012345,0.0271828182845904,1.04,6\n";

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return path(name);
  }
  void write_same_recording(const std::string& name) const {
    RecordingWriter writer(folder_ / name);
    test::write_usual_metadata(writer);
    writer.scalar("area_um", {80, 10, 400, 80, 80, 80, 77.123456789012345});
    writer.scalar("deform", {0.03, 0.03, 0.03, -0.01, 0.5, NAN, 0.0271828182845904});
    writer.scalar("inert_ratio_cvx", {1.05, 1.05, 1.05, 1.05, 1.05, 1.05, 1.04});
    writer.scalar("time", {0, 1, 2, 3, 4, 5, 6});
  }
  /// Without the comments, which name program, file and settings.
  std::string lines_of_events(const std::string& name) const {
    std::string lines;
    for (const auto& line : split(test::content_of(folder_ / name), '\n'))
      if (!line.starts_with('#')) lines += line + "\n";
    return lines;
  }
};

TEST_F(TextRecording, GivesTheModuliOfTheSameRecording) {
  write_same_recording("a.rtdc");
  ASSERT_EQ(extract({path("a.rtdc"), "-o", path("of_rtdc")}).exit_code, 0);
  const auto ended = extract({write("a.csv", std::string(set_up) + events), "-o", path("of_csv")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(lines_of_events("of_csv/a_rheocyte.tsv"), lines_of_events("of_rtdc/a_rheocyte.tsv"));
  const Recording of_csv(folder_ / "of_csv/a_rheocyte.rtdc"), of_rtdc(folder_ / "of_rtdc/a_rheocyte.rtdc");
  for (const char* feature : {"emodulus", "area_um", "deform", "time", "inert_ratio_cvx"}) {
    const auto text = column(of_csv, feature), binary = column(of_rtdc, feature);
    for (std::size_t i = 0; i < 7; ++i) EXPECT_TRUE(text[i] == binary[i] || std::isnan(binary[i])) << feature << i;
  }
  EXPECT_GT(column(of_csv, "emodulus")[0], 0);
}

TEST_F(TextRecording, OptionsReplaceASetUpThatIsMissing) {
  const auto file = write("a.csv", events);
  const auto refused = extract({file});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find(
                "a.csv: the set-up is incomplete: setup:channel width (--channel-width-um), setup:flow rate "
                "(--flow-rate-ul-s), imaging:pixel size (--pixel-size-um), setup:medium (--medium or "
                "--viscosity-mPas), setup:temperature (--temperature) are missing; give them as these options, or "
                "with the table (\"# setup:flow rate = 0.04\" in it, [setup] in a.toml; docs/text-recordings.md)."),
            std::string::npos)
      << refused.err;
  EXPECT_EQ(extract({file, "--channel-width-um", "20", "--flow-rate-ul-s", "0.04", "--pixel-size-um", "0.34",
                     "--medium", "CellCarrier", "--temperature", "23"})
                .exit_code,
            0);
}

TEST_F(TextRecording, ResultsBesideTablesArePassedOver) {
  const auto file = write("a.csv", std::string(set_up) + events);
  ASSERT_EQ(extract({file}).exit_code, 0);
  const auto again = extract({file, path("a_rheocyte.tsv"), path("a_rheocyte.rtdc")});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(again.err.find("are results of this program and were skipped"), std::string::npos) << again.err;
}

TEST_F(TextRecording, WhatNeedsOutlinesRefusesTables) {
  const auto file = write("a.csv", std::string(set_up) + events);
  const std::string words = "a.csv: has neither contours nor masks, from which ";
  for (const std::string command : {"moduli", "features"}) {
    const auto ended = test::run({{RHEOCYTE, command, file}});
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_NE(ended.err.find(words), std::string::npos) << ended.err;
  }
  const auto plotted = test::run({{RHEOCYTE, "plot", file, "-o", path("a.svg")}});
  EXPECT_EQ(plotted.exit_code, 0) << plotted.err;
}

}  // namespace
}  // namespace rheocyte::text_recording_test
