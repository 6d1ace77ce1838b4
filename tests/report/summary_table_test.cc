// The table of recordings keeps the lines of earlier calls, with one line for each recording and all columns in each.
#include "report/summary_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <thread>

#include "case/split.h"
#include "case/user_error.h"
#include "measurement/recording_writer.h"
#include "report/former_names.h"

namespace rheocyte::summary_table_test {
namespace {

SummaryLine line_of(const std::string& recording, std::size_t events) {
  SummaryLine line{.recording = recording, .summary = {}, .error = {}};
  line.summary.recorded = events;
  return line;
}

TEST(SummaryTable, EveryLineOfTheTableHasAllColumns) {
  ExtractSummary good;
  good.recorded = 1;
  good.table = "with\ttab";
  const std::vector<SummaryLine> lines{{"a.rtdc", good, {}}, {"b.rtdc", {}, "a sentence."}};
  const auto text = summary_table(lines);
  std::vector<long> tabs(1, 0);
  for (const char c : text) {
    if (c == '\t') ++tabs.back();
    if (c == '\n') tabs.push_back(0);
  }
  ASSERT_EQ(tabs.size(), 4U);
  EXPECT_EQ(tabs[1], tabs[0]);
  EXPECT_EQ(tabs[2], tabs[0]);
  EXPECT_TRUE(text.ends_with("\ta sentence.\n"));
}

TEST(SummaryTable, LinesOfOtherRecordingsStayAndThoseOfTheSameAreReplaced) {
  const std::vector<SummaryLine> first{line_of("b.rtdc", 1), line_of("c.rtdc", 2)},
      second{line_of("a.rtdc", 3), line_of("c.rtdc", 4)};
  const auto text = summary_table(second, summary_table(first));
  const std::vector<SummaryLine> all{line_of("a.rtdc", 3), line_of("b.rtdc", 1), line_of("c.rtdc", 4)};
  EXPECT_EQ(text, summary_table(all));
}

TEST(SummaryTable, CallsAtTheSameTimeLeaveTheLinesOfAll) {
  // As jobs of a workflow do, whose recordings lie in one folder.
  const test::ScratchFolder folder;
  constexpr int calls = 8;
  std::vector<std::thread> threads;
  for (int i = 0; i < calls; ++i)
    threads.emplace_back([&folder, i] {
      const std::vector<SummaryLine> lines{line_of(std::to_string(i) + ".rtdc", 1)};
      add_to_summary(folder / "out/rheocyte_summary.tsv", lines);
    });
  for (auto& thread : threads) thread.join();
  std::ifstream stream(folder / "out/rheocyte_summary.tsv");
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  EXPECT_EQ(std::ranges::count(text, '\n'), calls + 1) << text;
}

TEST(SummaryTable, ColumnsOfFormerNamesKeepTheirValuesUnderThePresentOnes) {
  const auto text = summary_table(
      std::vector<SummaryLine>{},
      "recording\tevents\tvalid\tflow_rate_ul_s\tyoung_modulus_median_error_kPa\nx.rtdc\t5\t2\t0.04\t0.7\n");
  const auto lines = split(text, '\n');
  const auto names = split(lines.at(0), '\t'), cells = split(lines.at(1), '\t');
  ASSERT_EQ(names.size(), cells.size());
  const auto cell = [&](std::string_view name) {
    const auto at = std::ranges::find(names, name);
    return at == names.end() ? "no such column" : std::string(cells[std::size_t(at - names.begin())]);
  };
  EXPECT_EQ(cell("flow_rate_ul_per_s"), "0.04");
  EXPECT_EQ(cell("young_modulus_median_kPa_error"), "0.7");
  for (const FormerName& name : former_names()) EXPECT_EQ(cell(name.former), "no such column") << name.former;
}

TEST(SummaryTable, OneThatTheVersionBeforeHasWrittenIsCompletedAndOtherFilesStay) {
  const test::ScratchFolder folder;
  const auto place = folder / "rheocyte_summary.tsv";
  const auto write = [&](const char* text) { std::ofstream(place) << text; };
  const std::vector<SummaryLine> lines{line_of("a.rtdc", 1)};
  write("recording\tevents\tvalid\tremarks\nx.rtdc\t5\t2\tOld.\n");
  add_to_summary(place, lines);
  add_to_summary(place, lines);
  write("recording\tmy own notes\n");
  EXPECT_THROW(add_to_summary(place, lines), UserError);
}

TEST(SummaryTable, LinesOfAnOlderVersionKeepWhatTheirColumnsHold) {
  const auto text =
      summary_table(std::vector<SummaryLine>{}, "recording\tevents\tvalid\tformer\tremarks\nx.rtdc\t5\t2\tno\tOld.\n");
  EXPECT_NE(text.find("\nx.rtdc\t"), std::string::npos) << text;
  EXPECT_NE(text.find("\t5\t2\t"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("\tOld.\n")) << text;
  EXPECT_EQ(text.find("former"), std::string::npos);
}

}  // namespace
}  // namespace rheocyte::summary_table_test
