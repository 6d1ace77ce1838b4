// A spec is a case without radius and stiffness and the ranges of a sweep; whatever is wrong with it is one sentence.
#include "table/table_spec.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "../refusal.h"
#include "case/case_text.h"
#include "case/problem.h"
#include "case/scales.h"
#include "case/user_error.h"
#include "case/write_case.h"
#include "invented_branch.h"
#include "table/dynamic_spec.h"
#include "table/table_keys.h"

namespace rheocyte::table_spec_test {
namespace {

using test::short_spec;

TableSpec read(const std::string& text, std::vector<std::string> settings = {}) {
  return parse_table_spec(text, "spec.toml", settings);
}

std::string refusal(const std::string& text, std::vector<std::string> settings = {}) {
  return test::refusal_of([&] { read(text, std::move(settings)); });
}

void expect_refusal(const std::string& setting, const std::string& words) {
  const auto sentence = refusal(short_spec, {setting});
  EXPECT_NE(sentence.find(words), std::string::npos) << "wanted: " << words << "\n   got: " << sentence;
  EXPECT_NE(sentence.find("--set"), std::string::npos) << sentence;
}

TEST(TableSpec, GivenValuesAreKeptAndTheOthersHaveTheirDefaults) {
  const auto spec = read(short_spec + "radii = 40\naccuracy = 1e-3\n");
  EXPECT_EQ(spec.identifier, "XX-2D-26");
  EXPECT_EQ(spec.stiffness_key, "cell.bulk.young_modulus_kPa");
  EXPECT_EQ(spec.radii, 40);
  EXPECT_EQ(spec.accuracy, 1e-3);
  EXPECT_EQ(spec.rows_per_radius, 120);
  EXPECT_EQ(spec.base.cell.bulk.law, BulkLaw::linear);
  EXPECT_EQ(spec.base.flow.density_kg_per_m3, 1000);
}

TEST(TableSpec, TheStiffnessIsThatOfTheBulkOrElseOfTheCortex) {
  const std::vector<std::string> shell{"cell.bulk.law=none", "cell.cortex.law=linear", "cell.cortex.tension_ratio=0.1"};
  EXPECT_EQ(read(short_spec, shell).stiffness_key, "cell.cortex.modulus_mN_per_m");
  const std::vector<std::string> both{"cell.cortex.law=linear", "table.stiffness=cell.cortex.modulus_mN_per_m",
                                      "cell.bulk.young_modulus_kPa=2"};
  const auto spec = read(short_spec, both);
  EXPECT_EQ(case_at(spec, {5}, 31).cell.cortex.modulus_mN_per_m, 31);
  EXPECT_EQ(case_at(spec, {5}, 31).cell.bulk.young_modulus_kPa, 2);
}

TEST(TableSpec, TheTextOfASpecGivesBackTheSameSpec) {
  const std::vector<std::string> shell{"cell.bulk.law=none",      "cell.cortex.law=neo-hookean",
                                       "table.radii=7",           "cell.cortex.tension_ratio=0.1",
                                       "table.accuracy=0.000123", "table.bending_beyond_kBT=1e4"};
  for (const auto& settings : {std::vector<std::string>{}, shell}) {
    const auto spec = read(short_spec, settings);
    const auto again = read(to_toml(spec));
    EXPECT_EQ(to_toml(again), to_toml(spec));
    EXPECT_EQ(case_hash(again.base), case_hash(spec.base));
    EXPECT_EQ(spec_hash(again), spec_hash(spec));
  }
  EXPECT_NE(spec_hash(read(short_spec)), spec_hash(read(short_spec, {"table.radii=99"})));
}

TEST(TableSpec, TheConstantsOfFungAndSkalakAreKept) {
  const std::vector<std::string> settings{"cell.bulk.law=fung", "cell.bulk.stiffening=0.7", "cell.cortex.law=skalak",
                                          "cell.cortex.area_constant=30", "table.cortex_fraction=[0, 0.5, 1]"};
  const auto spec = read(short_spec, settings), again = read(to_toml(spec));
  EXPECT_EQ(again.base.cell.bulk.stiffening, 0.7);
  EXPECT_EQ(again.base.cell.cortex.area_constant, 30);
  EXPECT_EQ(spec_hash(again), spec_hash(spec));
  EXPECT_EQ(case_at(spec, {5, 0.5}, 2).cell.bulk.stiffening, 0.7);
  auto other = settings;
  other[1] = "cell.bulk.stiffening=0.8";
  EXPECT_NE(spec_hash(read(short_spec, other)), spec_hash(spec));
}

TEST(TableSpec, TheTextOfASpecHoldsWhatSquareChannelsNeed) {
  const std::vector<std::string> settings{"channel.section=square", "table.max_area_um2=260", "table.computed_radii=9",
                                          "table.computed_states=5", "table.tube_table=LE-2D-26"};
  const auto spec = read(short_spec, settings), again = read(to_toml(spec));
  EXPECT_EQ(to_toml(again), to_toml(spec));
  EXPECT_EQ(again.computed_radii, 9);
  EXPECT_EQ(again.computed_states, 5);
  EXPECT_EQ(again.tube_table, "LE-2D-26");
  for (const auto* other : {"table.computed_radii=8", "table.computed_states=6", "table.tube_table=OTHER"}) {
    auto changed = settings;
    changed.emplace_back(other);
    EXPECT_NE(spec_hash(read(short_spec, changed)), spec_hash(spec)) << other;
  }
  EXPECT_EQ(to_toml(read(short_spec)).find("computed_"), std::string::npos) << "tables of the tube stay the same";
}

TEST(TableSpec, RadiiCoverTheAreasInsideTheTube) {
  const auto spec = read(short_spec);
  const auto radii = sweep_radii_um(spec);
  ASSERT_EQ(int(radii.size()), spec.radii);
  EXPECT_DOUBLE_EQ(radii.front(), std::sqrt(0.9 * 30 / std::numbers::pi));
  EXPECT_DOUBLE_EQ(radii.back(), std::sqrt(290 / std::numbers::pi));
  EXPECT_NEAR(radii[1] - radii[0], radii[99] - radii[98], 1e-12);  // rounding
  const auto full = sweep_radii_um(read(short_spec, {"table.min_area_um2=0.95", "table.max_area_um2=350"}));
  EXPECT_GE(full.front(), 0.05 * 10.94);
  EXPECT_LE(full.back(), 0.965 * 10.94);
}

TEST(TableSpec, ACaseOfTheSweepHasItsRadiusStiffnessAndAccuracy) {
  const Case c = case_at(read(short_spec), {6.5}, 2.25);
  EXPECT_EQ(c.cell.radius_um, 6.5);
  EXPECT_EQ(c.cell.bulk.young_modulus_kPa, 2.25);
  EXPECT_EQ(c.numerics.accuracy, 2e-4);
  EXPECT_NEAR(problem_of(c).radius_ratio, 6.5 / 10.94, 1e-15);
}

TEST(TableSpec, BendingOfCombinedCellsGoesWithTheirStiffness) {
  // c_b = 1e-3 S r0^3 in k_B T of 4.11643e-21 J: 2 kPa and 6 um have 4.32e-16 J; dimensionless it is the same for all.
  const std::vector<std::string> combined{"cell.cortex.law=neo-hookean", "table.cortex_fraction=[0, 0.5, 1]",
                                          "table.bending_ratio=1e-3", "table.max_deformation_raw=0.16"};
  const auto spec = read(short_spec, combined);
  for (const double fraction : {0.0, 0.5, 1.0}) {
    const Case c = case_at(spec, {6, fraction, 0}, 2);
    EXPECT_NEAR(c.cell.cortex.bending_kBT, 4.32e-16 / 4.11643e-21, 1);
  }
  const auto again = read(to_toml(spec));
  EXPECT_EQ(spec_hash(again), spec_hash(spec));
  EXPECT_EQ(again.max_deformation_raw, 0.16);
  EXPECT_EQ(to_toml(read(short_spec)).find("bending_ratio"), std::string::npos) << "tables without it stay the same";
  expect_refusal("table.bending_ratio=1e-3", "has no effect without table.cortex_fraction");
  auto both = combined;
  both.emplace_back("cell.cortex.bending_kBT=1e4");
  EXPECT_NE(refusal(short_spec, both).find("exclude each other"), std::string::npos);
}

TEST(TableSpec, TheFormerNameOfAKeyMakesTheSameTable) {
  const auto with = [](const std::string& key) {
    return read(short_spec, {"cell.cortex.law=neo-hookean", key + "=[0, 0.5, 1]"});
  };
  EXPECT_EQ(spec_hash(with("table.cortex_share")), spec_hash(with("table.cortex_fraction")));
}

TEST(TableSpec, InASquareChannelBendingBeyondTheEndGoesWithStiffnessAndSize) {
  // c_b = 3e-5 E r0^3 in k_B T of 4.11643e-21 J: 2 kPa and 6 um have 1.296e-17 J, as 12 mN/m have for shells.
  const std::string ratio = "table.bending_beyond_ratio=3e-5", square = "channel.section=square",
                    areas = "table.max_area_um2=260";
  const auto solid = read(short_spec, {square, areas, ratio});
  EXPECT_EQ(case_at(solid, {6}, 2).cell.cortex.bending_kBT, 0);
  EXPECT_NEAR(regularising_bending_kBT(solid, 6, 2), 1.296e-17 / 4.11643e-21, 0.1);
  EXPECT_EQ(case_at(regularised_spec(solid), {6}, 2).cell.cortex.bending_kBT, regularising_bending_kBT(solid, 6, 2));
  const auto shell = read(short_spec, {square, areas, ratio, "cell.bulk.law=none", "cell.cortex.law=linear"});
  EXPECT_NEAR(regularising_bending_kBT(shell, 6, 12), regularising_bending_kBT(solid, 6, 2), 1e-9);
  EXPECT_EQ(read(to_toml(solid)).bending_beyond_ratio, 3e-5);
  EXPECT_EQ(to_toml(read(short_spec, {square, areas})).find("bending_beyond_ratio"), std::string::npos);
  const auto early = read(short_spec, {square, areas, ratio, "table.bending_from_margin=0.25"});
  EXPECT_EQ(read(to_toml(early)).bending_from_margin, 0.25);
  EXPECT_EQ(to_toml(solid).find("bending_from_margin"), std::string::npos);
}

TEST(TableSpec, WhatHoldsTheSurfaceBeyondTheEndIsThatOfTheSection) {
  expect_refusal("table.bending_beyond_ratio=3e-5", "has no effect, because channel.section is \"tube\"");
  const auto refused = [](std::vector<std::string> settings) {
    settings.insert(settings.end(), {"channel.section=square", "table.max_area_um2=260"});
    return refusal(short_spec, std::move(settings));
  };
  EXPECT_NE(refused({"table.bending_beyond_kBT=1e4"}).find("give table.bending_beyond_ratio, such as 3e-5"),
            std::string::npos);
  EXPECT_NE(refused({"table.bending_beyond_ratio=0.1"}).find("outside its range 0 .. 0.001"), std::string::npos);
  EXPECT_NE(refused({"table.bending_from_margin=0.2"}).find("has no effect without table.bending_beyond_ratio"),
            std::string::npos);
  EXPECT_NE(refused({"cell.cortex.bending_kBT=1e4"}).find("choose table.bending_beyond_ratio"), std::string::npos);
}

TEST(TableSpec, SweptKeysMustNotBeGiven) {
  expect_refusal("cell.radius_um=5", "cell.radius_um = 5 must not be given, because a table sweeps it");
  expect_refusal("cell.bulk.young_modulus_kPa=5", "young_modulus_kPa = 5 must not be given");
  expect_refusal("numerics.accuracy=1e-4", "choose table.accuracy");
  expect_refusal("flow.pressure_drop_Pa=1000", "a table is that of one flow rate");
  expect_refusal("flow.drive=pressure-drop", "a table is that of one flow rate");
}

TEST(TableSpec, UnknownKeysAreNamedWithTheNearestOne) {
  expect_refusal("table.radi=5", "unknown key table.radi = 5, did you mean table.radii?");
  expect_refusal("tabel.radii=5", "did you mean table.radii?");
  expect_refusal("table.xyzxyzxyzxyz=5", "`rheocyte help table` lists all keys");
  expect_refusal("flow.viscosity=5", "did you mean flow.viscosity_mPas?");
}

TEST(TableSpec, ValuesOutsideTheirRangesAreNamed) {
  expect_refusal("table.radii=1", "table.radii = 1 is outside its range 2 .. 10000");
  expect_refusal("table.radii=2.5", "not a whole number");
  expect_refusal("table.radii=many", "is not a number");
  expect_refusal("table.radii=nan", "is not finite");
  expect_refusal("table.identifier=7", "must be a word");
  expect_refusal("table.min_area_um2=290", "is not below table.max_area_um2 = 290; the table would be empty");
  expect_refusal("table.max_deformation=1e-5", "the table would be empty");
  expect_refusal("table.max_area_um2=400", "an area that no cell of this channel can have");
  expect_refusal("table.min_area_um2=0.5", "an area that no cell of this channel can have");
}

TEST(TableSpec, IdentifiersOfOthersAndOddOnesAreRefused) {
  for (const auto* taken : {"LE-2D-FEM-19", "he-2d-fem-22", "HE-3D-FEM-22", "LE-2D-ana-18"})
    expect_refusal(std::string("table.identifier=") + taken, "is the name of a published table");
  for (const auto* odd : {"a/b", "a b", "a_b", "../x", "\"\""})
    expect_refusal(std::string("table.identifier=") + odd, "is not a name of a table");
  const auto nameless = short_spec.substr(0, short_spec.find("identifier"));
  EXPECT_NE(refusal(nameless).find("spec.toml: the key table.identifier is missing"), std::string::npos);
}

TEST(TableSpec, AStiffnessWithoutItsLawIsRefused) {
  expect_refusal("table.stiffness=cell.cortex.modulus_mN_per_m", "because cell.cortex.law is \"none\"");
  expect_refusal("table.stiffness=cell.bulk.young_modulus", "did you mean cell.bulk.young_modulus_kPa?");
  EXPECT_NE(refusal(short_spec, {"cell.bulk.law=none"}).find("choose a law"), std::string::npos);
  EXPECT_NE(
      refusal(short_spec, {"table.bending_beyond_kBT=1e3", "cell.cortex.bending_kBT=1e4"}).find("does not exceed"),
      std::string::npos);
}

TEST(TableSpec, MistakesOfTheCaseAreThoseOfACaseFile) {
  EXPECT_NE(refusal("").find("is empty"), std::string::npos);
  EXPECT_NE(refusal("[table]\nidentifier = \"a\"\n").find("channel.width_um"), std::string::npos);
  EXPECT_NE(refusal(short_spec + "radii = 3\nradii = 4\n").find("not valid TOML"), std::string::npos);
}

TEST(TableSpec, TheReferenceInDocsIsUpToDate) {
  std::ostringstream text;
  text << std::ifstream(TABLE_REFERENCE).rdbuf();
  EXPECT_EQ(text.str(), reference_markdown(table_reference()))
      << "run `build/rheocyte help table --markdown > docs/table-reference.md`";
}

TEST(DynamicSpec, TheReferenceInDocsIsUpToDate) {
  std::ostringstream text;
  text << std::ifstream(DYNAMIC_REFERENCE).rdbuf();
  EXPECT_EQ(text.str(), reference_markdown(dynamic_reference()))
      << "run `build/rheocyte help dynamic --markdown > docs/dynamic-reference.md`";
}

TEST(TableSpec, EveryReadySpecIsAGoodOne) {
  int specs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(EXAMPLES) + "/tables")) {
    const std::string text = read_case_text(entry.path()), name = entry.path().string();
    ++specs;
    if (is_dynamic_spec(text, name, {})) {
      const auto spec = parse_dynamic_spec(text, name);
      EXPECT_EQ(to_toml(parse_dynamic_spec(to_toml(spec), "again")), to_toml(spec)) << name;
      continue;
    }
    const auto spec = read_table_spec(entry.path());
    EXPECT_EQ(to_toml(parse_table_spec(to_toml(spec), "again")), to_toml(spec)) << name;
  }
  EXPECT_EQ(specs, 15);
}

}  // namespace
}  // namespace rheocyte::table_spec_test
