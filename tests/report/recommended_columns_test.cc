// What is recommended says what the summary does, in all its forms.
#include "report/recommended_columns.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "report/summary_columns.h"

namespace rheocyte::recommended_columns_test {
namespace {

ExtractSummary of_round_cells() {
  ExtractSummary s;
  s.recorded = s.shapes.judged = 100;
  s.shapes.excess = {0.001, 0.001, no_value};
  s.shapes.by_deformation = {
      .median_kPa = {.place = MedianPlace::inside, .value = 2.4657, .error = 0.0412, .half_range = 0, .known = 100},
      .common_error = 0.0783 / 2.4657};
  return s;
}

TEST(RecommendedColumns, AreTheFirstOfTheSummaryAndSayTheSameEverywhere) {
  const ExtractSummary s = of_round_cells();
  const auto said = recommended_json(s);
  const auto lines = recommended_lines(s);
  const auto& recommended = recommended_columns();
  std::size_t told = 0;
  ASSERT_GE(recommended.size(), 5U);
  EXPECT_EQ(said.size(), recommended.size());
  for (std::size_t k = 0; k < recommended.size(); ++k) {
    const auto& column = summary_columns().at(k);
    EXPECT_EQ(column.name, start_of_recommended + recommended[k].name);
    const std::string text = summary_text(column, s), name = recommended[k].name;
    ASSERT_TRUE(said.contains(name)) << name;
    EXPECT_EQ(said[name].is_null(), text.empty()) << name;
    if (text.empty()) continue;
    ASSERT_LT(told, lines.size());
    EXPECT_EQ(lines[told++], column.name + ": " + text);
    if (said[name].is_string()) {
      EXPECT_EQ(said[name], text);
    } else {
      EXPECT_EQ(said[name], std::stod(text));
    }
  }
  EXPECT_EQ(lines.size(), told);
}

TEST(RecommendedColumns, TheNumberStandsWithItsErrorsInShort) {
  ExtractSummary s = of_round_cells();
  EXPECT_EQ(recommended_in_short(s), "recommended: E = 2.47 +- 0.041 +- 0.078 kPa");
  s.shapes.by_deformation = {};
  EXPECT_EQ(recommended_in_short(s), "no modulus is recommended");
}

}  // namespace
}  // namespace rheocyte::recommended_columns_test
