// Runs `rheocyte extract` on small recordings with a look-up table that can be followed by hand.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "case/split.h"
#include "lookup_table_file.h"
#include "measurement/recording.h"
#include "measurement/recording_columns.h"
#include "measurement/recording_writer.h"
#include "robustness/run_program.h"

namespace rheocyte::test {

/// Greatest relative rounding of what companions hold.
inline constexpr double single_precision = 6e-8;

/// How many events the summary says that a recording has; empty without a line of it.
inline std::string events_in_summary(const std::filesystem::path& summary, const std::string& recording) {
  const auto lines = split(content_of(summary), '\n');
  const auto names = split(lines.front(), '\t');
  const auto at = std::size_t(std::ranges::find(names, "events") - names.begin());
  for (const auto& line : lines)
    if (const auto cells = split(line, '\t'); cells.front() == recording) return cells.at(at);
  return {};
}

/// A folder with a table and what the test puts into it.
class ExtractFixture : public testing::Test {
 protected:
  ExtractFixture() { test::write_lookup_table(folder_ / "table.txt"); }

  test::Ended extract(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {RHEOCYTE, "extract", "--table", (folder_ / "table.txt").string()});
    return test::run({arguments});
  }

  /// Six events at the table's own channel and flow; the last one has no deformation.
  void write_recording(const std::string& name, const std::function<void(RecordingWriter&)>& more = {}) const {
    RecordingWriter writer(folder_ / name);
    test::write_usual_metadata(writer);
    writer.scalar("area_um", {80, 10, 400, 80, 80, 80});
    writer.scalar("deform", {0.03, 0.03, 0.03, -0.01, 0.5, NAN});
    if (more) more(writer);
  }

  void expect_refusal(const std::vector<std::string>& arguments, const std::string& words) const {
    const auto ended = extract(arguments);
    EXPECT_EQ(ended.exit_code, 2) << words;
    EXPECT_NE(ended.err.find(words), std::string::npos) << "wanted: " << words << "\n   got: " << ended.err;
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  ScratchFolder folder_;
};

}  // namespace rheocyte::test
