// A dynamic table gives back the ways of its cells, and those of cells between them.
#include "table/dynamic_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "../refusal.h"
#include "invented_dynamic.h"

namespace rheocyte::dynamic_table_test {
namespace {

namespace fs = std::filesystem;
using test::refusal_of;

DynamicSpec spec_with(const std::string& setting) {
  return parse_dynamic_spec(test::dynamic_spec_text, "spec.toml", std::vector{setting});
}

TEST(DynamicTable, BetweenItsCellsAndPlacesItFollowsASmoothLawWithinAPercent) {
  const DynamicTable table(test::invented_dynamic());
  for (const DynamicCell& cell : {DynamicCell{5.3, 1.8, 0.09}, {6.6, 5, 0.4}, {7.1, 9, 1.7}, {7.9, 3.3, 7}})
    for (const double place : {10.0, 23.0, 57.0, 191.0, 307.0}) {
      // 1 % of the greatest value on the way: what the tables promise.
      const double greatest = test::invented_mode_3(cell, 310);
      EXPECT_NEAR(table.value(CourseMeasure::mode_3, cell, place), test::invented_mode_3(cell, place), 0.01 * greatest);
    }
  EXPECT_LT(table.errors().mode_3, 0.01);
  EXPECT_EQ(table.errors().cells, 4);
}

TEST(DynamicTable, AtItsNodesItIsExact) {
  const DynamicTable table(test::invented_dynamic());
  const CellCourse& course = table.content().courses[17];
  const double place = places_of(table.spec())[5];
  for (int m = 0; m < course_measures; ++m)
    EXPECT_NEAR(table.value(CourseMeasure(m), course.cell, place), course.value(5, m), 1e-12);  // rounding
}

TEST(DynamicTable, ItsSpecAndItsFileGiveBackTheSame) {
  const DynamicContent content = test::invented_dynamic();
  const std::string text = to_toml(content.spec);
  EXPECT_EQ(to_toml(parse_dynamic_spec(text, "again.toml")), text);
  const DynamicContent again = dynamic_from_bytes(to_bytes(content), "table");
  ASSERT_EQ(again.courses.size(), content.courses.size());
  EXPECT_EQ(again.courses.back().value, content.courses.back().value);
}

TEST(DynamicTable, AnyChangedByteOfItsFileIsRefusedInASentence) {
  const std::string bytes = to_bytes(test::invented_dynamic());
  for (std::size_t at = 3; at < bytes.size(); at += bytes.size() / 23) {
    std::string damaged = bytes;
    damaged[at] = char(damaged[at] ^ 0x21);
    const std::string refusal = refusal_of([&] { dynamic_from_bytes(damaged, "table.cbor"); });
    EXPECT_TRUE(refusal.starts_with("table.cbor: this dynamic table cannot be used: ")) << refusal;
  }
  EXPECT_NE(refusal_of([&] { dynamic_from_bytes(bytes.substr(0, 1000), "table.cbor"); }), "accepted");
}

TEST(DynamicTable, NumbersThatNoCellHasAndCellsOfOtherNodesAreRefusedInASentence) {
  // Each file has a right checksum: only its numbers are wrong.
  const DynamicContent sound = test::invented_dynamic();
  const auto refusal = [&](const auto& change) {
    DynamicContent changed = sound;
    change(changed.courses);
    return refusal_of([&] { dynamic_from_bytes(to_bytes(changed), "table.cbor"); });
  };
  using Courses = std::vector<CellCourse>;
  const auto of = [](CourseMeasure measure) { return int(measure); };
  const std::string numbers = "the way of a cell contains numbers that no cell has",
                    cells = "a cell is not the one that its spec has in this place";
  for (const auto& [change, words] : std::vector<std::pair<std::function<void(Courses&)>, std::string>>{
           {[](Courses& all) {
              for (auto& course : all) course.value.setZero();
            },
            numbers},
           {[&](Courses& all) { all[3].value(2, of(CourseMeasure::mode_3)) = NAN; }, numbers},
           {[&](Courses& all) { all[3].value(2, of(CourseMeasure::mode_3)) = 1e300; }, numbers},
           {[&](Courses& all) { all[3].value.col(of(CourseMeasure::time)).reverseInPlace(); }, numbers},
           {[&](Courses& all) { all[3].value.col(of(CourseMeasure::area_ratio)) *= -1; }, numbers},
           {[](Courses& all) { std::ranges::reverse(all); }, cells},
           {[](Courses& all) { std::swap(all[1], all[2]); }, cells},
           {[](Courses& all) { all[5].cell.radius_um *= -1; }, cells},
           {[](Courses& all) { all[5].cell.young_modulus_kPa *= 1.001; }, cells},
           {[](Courses& all) { all[5].cell.time_ms *= 2; }, cells},
           {[](Courses& all) { all.pop_back(); }, "its content does not agree with its spec"}})
    EXPECT_NE(refusal(change).find(words), std::string::npos) << refusal(change);
  EXPECT_NE(refusal([](Courses& all) { all[5].cell.time_ms = NAN; }), "accepted");
}

TEST(DynamicTable, WhatItsSpecMustNotSayIsRefusedInASentence) {
  const auto refusal = [](const std::string& setting) { return refusal_of([&] { spec_with(setting); }); };
  EXPECT_NE(refusal("cell.radius_um=6").find("must not be given, because a dynamic table chooses it"),
            std::string::npos);
  EXPECT_NE(refusal("time.end_us=100").find("must not be given"), std::string::npos);
  EXPECT_NE(refusal("dynamic.max_radius_um=4").find("is not below"), std::string::npos);
  EXPECT_NE(refusal("dynamic.max_radius_um=40").find("outside its range"), std::string::npos);
  EXPECT_NE(refusal("dynamic.identifier=a b").find("not a name of a table"), std::string::npos);
  EXPECT_NE(refusal("cell.bulk.law=none"), "accepted");
  EXPECT_NE(refusal("channel.section=rectangle").find("computed in tubes and in the square channel"),
            std::string::npos);
  const std::string straight =
      "[channel]\nwidth_um = 20\n" + test::dynamic_spec_text.substr(test::dynamic_spec_text.find("[flow]"));
  EXPECT_NE(refusal_of([&] { parse_dynamic_spec(straight, "spec.toml"); }).find("needs the contraction"),
            std::string::npos);
  EXPECT_EQ(parse_dynamic_spec(test::square_dynamic_spec_text, "spec.toml").base.channel.section, Section::square);
}

}  // namespace
}  // namespace rheocyte::dynamic_table_test
