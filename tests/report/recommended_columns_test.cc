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

TEST(RecommendedColumns, AllColumnsOfTheSummaryThatRecommendAreGivenByTheirNames) {
  const ExtractSummary s = of_round_cells();
  const auto said = recommended_json(s);
  const auto lines = recommended_lines(s);
  std::size_t columns = 0, told = 0;
  for (const auto& column : summary_columns()) {
    if (!column.name.starts_with("recommended_")) continue;
    ++columns;
    const std::string text = summary_text(column, s), name = column.name.substr(12);
    ASSERT_TRUE(said.contains(name)) << name;
    EXPECT_EQ(said[name].is_null(), text.empty()) << name;
    if (text.empty()) continue;
    ASSERT_LT(told, lines.size());
    EXPECT_EQ(lines[told++], column.name + ": " + text);
    if (said[name].is_string()) {
      EXPECT_EQ(said[name], text);
    }
  }
  EXPECT_GE(columns, 5U);
  EXPECT_EQ(said.size(), columns);
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
