// The table of recordings keeps the lines of earlier calls, with one line for each recording and all columns in each.
#include "report/summary_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <thread>

#include "measurement/recording_writer.h"

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

TEST(SummaryTable, LinesOfAnOlderVersionKeepWhatTheirColumnsHold) {
  const auto text =
      summary_table(std::vector<SummaryLine>{}, "recording\tevents\tvalid\tformer\tremarks\nx.rtdc\t5\t2\tno\tOld.\n");
  EXPECT_NE(text.find("\nx.rtdc\t5\t2\t"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("\tOld.\n")) << text;
  EXPECT_EQ(text.find("former"), std::string::npos);
}

}  // namespace
}  // namespace rheocyte::summary_table_test
