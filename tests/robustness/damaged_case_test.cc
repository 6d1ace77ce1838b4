// No bytes in a case file make the program crash or hang: it ends with 0, or with 2 and one sentence.
#include <gtest/gtest.h>

#include <random>

#include "run_program.h"

namespace rheocyte::test::damaged_case_test {
namespace {

const std::string good_text = content_of(std::string(EXAMPLES) + "/paper-cell.toml");

Ended check(const std::string& text) {
  static const TemporaryFolder folder;
  const auto file = folder.path() / "damaged.toml";
  write_file(file, text);
  return run({{RHEOCYTE, "solve", "--check", file.string()}});
}

void expect_refusal(const std::string& text, const std::string& words) { expect_sentence(check(text), words); }

void expect_result_or_sentence(const std::string& text) {
  const auto ended = check(text);
  ASSERT_TRUE(ended.exit_code == 0 || ended.exit_code == 2) << ended.exit_code << "\n" << ended.err << "\n" << text;
  ASSERT_EQ(is_one_line(ended.err), ended.exit_code == 2) << ended.err;
  ASSERT_EQ(ended.out, "");
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

TEST(DamagedCase, DeepNestingIsRefusedBeforeParsing) {
  for (const int depth : {100, 1000, 100000}) {
    expect_refusal("a = " + repeated("[", depth), "nested deeper than");
    expect_refusal("a = " + repeated("[\n", depth), "nested deeper than");
    expect_refusal("a = " + repeated("{a=", depth), "nested deeper than");
    expect_refusal("a" + repeated(".a", depth) + " = 1", "nested deeper than");
    expect_refusal("[a" + repeated(" . \"a\"", depth) + "]", "nested deeper than");
    expect_refusal("s = \"\"\"quoted\"\"\"\"\nb = " + repeated("[", depth), "nested deeper than");
  }
}

TEST(DamagedCase, BracketsInCommentsAndTextsAreNoNesting) {
  EXPECT_EQ(check("# " + repeated("[", 1000) + "\n" + good_text).exit_code, 0);
  expect_refusal(good_text + "note = \"" + repeated("[", 1000) + "\"\n", "unknown key numerics.note");
}

TEST(DamagedCase, TooLargeOrNoTextIsNamed) {
  expect_refusal(good_text + "#" + std::string(2 << 20, 'x'), "larger than 1024 KiB");
  expect_refusal(good_text + std::string(1, '\0'), "a zero byte");
  expect_refusal(good_text + "# \xff\xfe\n", "not UTF-8");
  expect_refusal(good_text + "# \xc3", "not UTF-8");
  expect_refusal(std::string("\xff\xfe[\0c\0", 6), "a zero byte");
  expect_refusal(
      "\x7f"
      "ELF\x02\x01",
      "not valid TOML");
}

TEST(DamagedCase, AByteOrderMarkAndCarriageReturnsDoNotHarm) {
  std::string windows = "\xEF\xBB\xBF";
  for (const char letter : good_text) windows += letter == '\n' ? std::string("\r\n") : std::string(1, letter);
  EXPECT_EQ(check(windows).exit_code, 0);
}

TEST(DamagedCase, EveryCutGivesAResultOrASentence) {
  for (std::size_t length = 0; length < good_text.size(); length += 7)
    expect_result_or_sentence(good_text.substr(0, length));
}

TEST(DamagedCase, RandomBytesGiveASentence) {
  std::mt19937 random(1);
  for (int i = 0; i < 50; ++i) {
    std::string bytes(1 + random() % 400, ' ');
    for (char& byte : bytes) byte = static_cast<char>(random() & 0xFF);
    EXPECT_EQ(check(bytes).exit_code, 2);
  }
}

// One random change: a byte replaced, a piece deleted, doubled or moved, or a hostile word inserted.
std::string mutated(std::string text, std::mt19937& random) {
  static const std::vector<std::string> hostile{"[",       "{",  "}",          "\"", "\"\"\"",   "'",   "=",
                                                ".",       "\n", "1e400",      "-",  "nan",      "inf", "[[cell]]",
                                                "\\u0000", "0x", "1979-05-27", "#",  "\xC3\xA9", "_"};
  const std::size_t at = random() % text.size(), length = 1 + random() % 20;
  switch (random() % 5) {
    case 0: text[at] = static_cast<char>(random() & 0xFF); break;
    case 1: text.erase(at, length); break;
    case 2: text.insert(at, text.substr(at, length)); break;
    case 3: text.insert(random() % text.size(), text.substr(at, length)); break;
    default: text.insert(at, hostile[random() % hostile.size()]);
  }
  return text;
}

TEST(DamagedCase, RandomMutationsGiveAResultOrASentence) {
  std::mt19937 random(2);
  for (int i = 0; i < 400; ++i) {
    std::string text = good_text;
    for (unsigned changes = 1 + random() % 4; changes > 0; --changes) text = mutated(text, random);
    expect_result_or_sentence(text);
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace rheocyte::test::damaged_case_test
