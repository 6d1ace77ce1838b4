// What is recommended says what the summary does, in all its forms.
#include "extract/recommendation.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "extract/summary_columns.h"

namespace rheocyte::recommendation_test {
namespace {

ExtractSummary of_round_cells() {
  ExtractSummary s;
  s.events = s.shapes.judged = s.shapes.with_deformation = 100;
  s.shapes.excess = {0.001, 0.001, no_value};
  s.shapes.by_deformation_kPa = {2.4657, 0.0412, 0.0783};
  return s;
}

TEST(Recommendation, AllColumnsOfTheSummaryThatRecommendAreToldByTheirNames) {
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

TEST(Recommendation, WithoutANumberItSaysSoInShort) {
  EXPECT_EQ(recommended_in_short({}), "no modulus is recommended");
  const ExtractSummary s = of_round_cells();
  const bool has_number = recommended_json(s)["young_modulus_median_kPa"].is_number();
  EXPECT_EQ(recommended_in_short(s).starts_with("recommended: E = 2.47 +- 0.041"), has_number);
}

}  // namespace
}  // namespace rheocyte::recommendation_test
