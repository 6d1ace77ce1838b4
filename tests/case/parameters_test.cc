// The table of parameters is consistent with itself, and the reference in docs is made from it.
#include "case/parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "case/case_reference.h"

namespace rheocyte {
namespace {

TEST(Parameters, HaveUniqueKeysAndASentence) {
  std::set<std::string_view> keys;
  for (const auto& parameter : parameters()) {
    EXPECT_TRUE(keys.insert(parameter.key).second) << parameter.key;
    EXPECT_FALSE(parameter.sentence.empty()) << parameter.key;
    EXPECT_EQ(find_parameter(parameter.key), &parameter);
  }
  EXPECT_EQ(find_parameter("cell.colour"), nullptr);
}

TEST(Parameters, HaveFiniteRangesThatHoldTheirDefault) {
  for (const auto& parameter : parameters()) {
    const auto* number = std::get_if<Number>(&parameter.value);
    if (!number) continue;
    EXPECT_TRUE(std::isfinite(number->range.least) && std::isfinite(number->range.greatest)) << parameter.key;
    EXPECT_FALSE(number->range.contains(std::nan("")));
    EXPECT_TRUE(number->range.contains(number->fallback.value_or(number->range.least))) << parameter.key;
  }
}

TEST(Parameters, ReferToOtherParametersThatExist) {
  for (const auto& parameter : parameters()) {
    if (!parameter.alternative.empty()) {
      ASSERT_TRUE(find_parameter(parameter.alternative)) << parameter.key;
      EXPECT_EQ(find_parameter(parameter.alternative)->alternative, parameter.key);
    }
    if (!parameter.only_for) continue;
    ASSERT_TRUE(find_parameter(parameter.only_for->key)) << parameter.key;
    const auto& options = std::get<Choice>(find_parameter(parameter.only_for->key)->value).options;
    EXPECT_EQ(std::count(options.begin(), options.end(), parameter.only_for->option), 1) << parameter.key;
  }
}

TEST(Parameters, AreReadAndWrittenThroughTheSameMember) {
  for (const auto& parameter : parameters()) {
    Case c;
    if (const auto* number = std::get_if<Number>(&parameter.value)) {
      number->set(c, 0.375);
      EXPECT_EQ(number->get(c), 0.375) << parameter.key;
    } else if (const auto* list = std::get_if<List>(&parameter.value)) {
      list->at(c) = {1, 2.5};
      EXPECT_EQ(list->at(c), (std::vector{1, 2.5})) << parameter.key;
    } else {
      const auto& choice = std::get<Choice>(parameter.value);
      for (int option = 0; option < static_cast<int>(choice.options.size()); ++option) {
        choice.set(c, option);
        EXPECT_EQ(choice.get(c), option) << parameter.key;
      }
    }
  }
}

TEST(CaseReference, InDocsIsUpToDate) {
  std::ostringstream text;
  text << std::ifstream(CASE_REFERENCE).rdbuf();
  EXPECT_EQ(text.str(), case_reference_markdown())
      << "run `build/rheocyte help case --markdown > docs/case-reference.md`";
}

}  // namespace
}  // namespace rheocyte
