// Every bad case of the corpus ends with exit code 2 and one sentence that names file, line, key, value and range.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <sstream>

#include "run_program.h"

namespace rheocyte::test::bad_case_test {
namespace {

namespace fs = std::filesystem;

struct BadCase {
  fs::path file;
};

void PrintTo(const BadCase& bad, std::ostream* stream) { *stream << bad.file.filename().string(); }

std::vector<BadCase> corpus() {
  std::vector<BadCase> cases;
  for (const auto& entry : fs::directory_iterator(BAD_CASES)) cases.push_back({entry.path()});
  std::ranges::sort(cases, {}, &BadCase::file);
  return cases;
}

// The words behind "# expected:", separated by "; ".
std::vector<std::string> expected_words(const fs::path& file) {
  const std::string mark = "# expected: ", text = content_of(file);
  const auto start = text.find(mark) + mark.size();
  std::vector<std::string> words;
  for (std::string rest = text.substr(start, text.find('\n', start) - start); !rest.empty();) {
    const auto end = rest.find("; ");
    words.push_back(rest.substr(0, end));
    rest = end == std::string::npos ? "" : rest.substr(end + 2);
  }
  return words;
}

class EveryBadCase : public testing::TestWithParam<BadCase> {};

TEST_P(EveryBadCase, EndsWithOneSentence) {
  const auto& file = GetParam().file;
  const auto ended = run({{RHEOCYTE, "solve", file.string(), "-o", "never-written"}});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.out, "");
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_TRUE(ended.err.starts_with(file.string())) << ended.err;
  const auto words = expected_words(file);
  EXPECT_FALSE(words.empty());
  for (const auto& word : words) EXPECT_NE(ended.err.find(word), std::string::npos) << word << "\n" << ended.err;
  EXPECT_FALSE(fs::exists("never-written"));
}

INSTANTIATE_TEST_SUITE_P(Corpus, EveryBadCase, testing::ValuesIn(corpus()),
                         [](const auto& information) { return information.param.file.stem().string(); });

TEST(BadCases, AreMany) { EXPECT_GE(corpus().size(), 60u); }

}  // namespace
}  // namespace rheocyte::test::bad_case_test
