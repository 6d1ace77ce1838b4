// Tables of elongated cells: what is between the computed states, and their file.
#include "table/elongated_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../refusal.h"
#include "case/user_error.h"
#include "invented_elongated.h"

namespace rheocyte::elongated_table_test {
namespace {

using namespace test;

constexpr int mode_2 = number_of(ElongatedMeasure::mode_2), mode_3 = number_of(ElongatedMeasure::mode_3);

TEST(ElongatedTable, GivesBackTheInventedCellsBetweenTheirStates) {
  const ElongatedTable table(invented_elongated_content());
  for (const double radius : {3.4, 5.1, 7.7})
    for (const double axial : {-0.05, 0.0, 0.11, 0.37})
      for (const double modulus : {3.0, 1.5}) {
        const double end = table.at({table.coordinate_of(radius), axial, 1}).log_modulus;
        const ElongatedState state = table.at({table.coordinate_of(radius), axial, std::exp(end) / modulus});
        const InventedElongated cell{radius, axial, modulus};
        EXPECT_NEAR(state.radius_um, radius, 1e-9);
        EXPECT_NEAR(std::exp(state.log_modulus), modulus, 1e-9 * modulus);
        EXPECT_NEAR(state.value(mode_2), cell.mode_2(), 1e-5) << radius << " " << axial << " " << modulus;
        EXPECT_NEAR(state.value(mode_3), cell.mode_3(), 1e-4 * cell.mode_3()) << radius << " " << axial;
        EXPECT_NEAR(state.log_area(), std::log(cell.area_um2()), 1e-5);
      }
}

TEST(ElongatedTable, ItsSlopesAreThoseOfItsValues) {
  const ElongatedTable table(invented_elongated_content());
  const ElongatedCell cell{0.41, 0.13, 0.52};
  const ElongatedState state = table.at(cell);
  constexpr double step = 1e-6;
  for (int i = 0; i < 3; ++i) {
    const ElongatedState more = table.at(cell + step * ElongatedCell::Unit(i)),
                         less = table.at(cell - step * ElongatedCell::Unit(i));
    for (int m = 0; m < elongated_measures; ++m)
      EXPECT_NEAR(state.slope(m, i), (more.value(m) - less.value(m)) / (2 * step), 1e-6) << m << " " << i;
    EXPECT_NEAR(state.log_modulus_slope(i), (more.log_modulus - less.log_modulus) / (2 * step), 1e-6) << i;
    EXPECT_NEAR(state.log_area_slope()(i), (more.log_area() - less.log_area()) / (2 * step), 1e-6) << i;
  }
}

TEST(ElongatedTable, WithoutTheTensionACellKeepsItsRadiusAndModulus) {
  const ElongatedTable table(invented_elongated_content());
  const ElongatedCell cell{0.3, 0.2, 0.6}, round = table.without_elongation(cell);
  EXPECT_EQ(round(1), 0);
  EXPECT_NEAR(table.at(round).radius_um, table.at(cell).radius_um, 1e-12);
  EXPECT_NEAR(table.at(round).log_modulus, table.at(cell).log_modulus, 1e-9);
}

TEST(ElongatedTable, SurvivesItsFileAndDamageIsNamed) {
  const ElongatedContent content = invented_elongated_content();
  std::string bytes = to_bytes(content);
  const ElongatedContent read = elongated_from_bytes(bytes, "a table");
  EXPECT_EQ(read.radii_um, content.radii_um);
  EXPECT_EQ(read.axial_ratios, content.axial_ratios);
  EXPECT_EQ(read.modulus_kPa, content.modulus_kPa);
  EXPECT_EQ(read.value, content.value);
  EXPECT_EQ(read.origin.section, Section::square);
  EXPECT_EQ(read.elongation, Elongation::by_tension);
  ElongatedContent at_rest = content;
  at_rest.elongation = Elongation::by_rest_shape;
  EXPECT_EQ(elongated_from_bytes(to_bytes(at_rest), "a table").elongation, Elongation::by_rest_shape);
  bytes[bytes.size() / 2] ^= 1;
  EXPECT_THROW(elongated_from_bytes(bytes, "a table"), UserError);
  EXPECT_THROW(elongated_from_bytes("", "a table"), UserError);
}

TEST(ElongatedTable, ABranchWithoutStatesIsNamed) {
  auto branches = invented_elongated_branches();
  branches.pop_back();
  try {
    elongated_content(invented_elongated_spec(), branches, "test");
    FAIL();
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("axial ratio 0.45"), std::string::npos) << error.what();
  }
}

/// A spec of solids in the square channel, with more keys of [table].
TableSpec spec_with(const std::string& keys, const char* section = "square") {
  return parse_table_spec("[channel]\nsection = \"" + std::string(section) +
                              "\"\nwidth_um = 20\n[flow]\nrate_ul_per_s = 0.04\nviscosity_mPas = 15\n[table]\n"
                              "identifier = \"test\"\n" +
                              keys,
                          "spec.toml");
}

TEST(TableSpecOfElongatedCells, MayBeLongAtRestInPlaceOfUnderATension) {
  const std::string ratios = "axial_ratio = [-0.1, 0, 0.1, 0.25]\n";
  const TableSpec pulled = spec_with(ratios), rested = spec_with(ratios + "elongated_by = \"rest-shape\"");
  const SweepPoint place{.radius_um = 6, .axial_ratio = 0.25};
  const Case under_tension = case_at(pulled, place, 2), at_rest = case_at(rested, place, 2);
  EXPECT_NEAR(under_tension.flow.axial_tension_Pa, 500, 1e-9);
  EXPECT_EQ(under_tension.cell.rest_aspect, 1);
  EXPECT_EQ(at_rest.flow.axial_tension_Pa, 0);
  EXPECT_NEAR(at_rest.cell.rest_aspect, 1.39087, 1e-5);  // what 500 Pa make of 2 kPa without flow
  // Folders of tables that were begun before there was the key go on.
  EXPECT_EQ(to_toml(pulled).find("elongated_by"), std::string::npos);
  EXPECT_EQ(parse_table_spec(to_toml(rested), "spec.toml").elongation, Elongation::by_rest_shape);
  EXPECT_THROW(spec_with("elongated_by = \"rest-shape\""), UserError);
}

TEST(TableSpecOfElongatedCells, WantsSolidsInTheSquareAndZeroAmongTheRatios) {
  EXPECT_TRUE(spec_with("axial_ratio = [-0.1, 0, 0.1, 0.3]").is_elongated());
  EXPECT_THROW(spec_with("axial_ratio = [0.1, 0.2, 0.3, 0.4]"), UserError);
  EXPECT_THROW(spec_with("axial_ratio = [0, 0.3]"), UserError);
  EXPECT_THROW(spec_with("axial_ratio = [-0.1, 0, 0.1, 0.3]", "tube"), UserError);
}

TEST(TableSpecOfElongatedCells, WantsALawWhoseElongationIsThatOfItsTension) {
  const std::string spec = to_toml(spec_with("axial_ratio = [-0.1, 0, 0.1, 0.3]"));
  const std::vector<std::string> fung{"cell.bulk.law=fung"};
  EXPECT_NE(test::refusal_of([&] { parse_table_spec(spec, "spec.toml", fung); }).find("choose another law"),
            std::string::npos);
}

}  // namespace
}  // namespace rheocyte::elongated_table_test
