// Rows lie on the branches, inside the ranges of the spec; equal branches give equal files to the byte.
#include "table/lookup_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "case/channel_flow.h"
#include "invented_branch.h"
#include "table/table_lines.h"
#include "table/table_metadata.h"

namespace rheocyte::lookup_table_test {
namespace {

using namespace test;

TableSpec spec_with(std::vector<std::string> settings) {
  settings.insert(settings.begin(), {"table.radii=12", "table.rows_per_radius=30", "table.bending_beyond_kBT=1e4"});
  return parse_table_spec(short_spec, "spec.toml", settings);
}

TEST(LookupTable, RowsAreStatesOfTheBranches) {
  const auto spec = spec_with({});
  const auto branches = invented_branches(spec, 60);
  const auto table = make_lookup_table(spec, branches, "0");
  ASSERT_GE(table.rows.size(), 300u);
  for (const auto& row : table.rows) {
    const double d = row.at(Measure::deformation), area = row.at(Measure::area_um2);
    // The error of cubic interpolation between 60 samples.
    EXPECT_NEAR(row.state.stiffness / invented_modulus(area, d), 1, 2e-6);
    EXPECT_TRUE(d >= 5e-5 && d <= 0.19 && area >= 30 && area <= 290);
    EXPECT_FALSE(row.is_end || row.state.regularised);
    // Half the error of the deformation for stiff cells, d ~ E^-2; more for softer ones.
    EXPECT_GT(row.stiffness_error, 0.49 * row.state.error);
    EXPECT_LT(row.stiffness_error, 1.1 * row.state.error);
  }
}

TEST(LookupTable, RowsAreAtDeformationsOfEqualRatio) {
  const auto spec = spec_with({});
  const auto levels = deformation_levels(spec);
  ASSERT_EQ(levels.size(), 30u);
  EXPECT_EQ(levels.front(), 5e-5);
  EXPECT_EQ(levels.back(), 0.19);
  for (std::size_t i = 2; i < 30; ++i)  // rounding
    EXPECT_NEAR(levels[i] / levels[i - 1], levels[1] / levels[0], 1e-12);
}

TEST(LookupTable, BeyondTheEndOfABranchRowsAreMarkedOrLeftOut) {
  const auto with = spec_with({}), without = spec_with({"table.bending_beyond_kBT=0"});
  const auto branches = invented_unstable_branches(with);
  const auto table = make_lookup_table(with, branches, "0");
  const auto bare = make_lookup_table(without, branches, "0");
  EXPECT_GT(table.regularised_rows(), 10);
  EXPECT_EQ(bare.regularised_rows(), 0);
  EXPECT_EQ(bare.rows.size() + std::size_t(table.regularised_rows()), table.rows.size());
  double last_radius = 0, last_deformation = 0;
  bool was_regularised = false;
  for (const auto& row : table.rows) {
    if (row.radius_um != last_radius) last_deformation = 0, was_regularised = false;
    EXPECT_GT(row.at(Measure::deformation), last_deformation);
    EXPECT_TRUE(row.state.regularised || !was_regularised);  // no bare row behind a regularised one
    last_radius = row.radius_um, last_deformation = row.at(Measure::deformation);
    was_regularised = row.state.regularised;
  }
  const auto text = parse_table_text(lut_text(table, Abscissa::area), "x");
  EXPECT_GT(text.metadata.at("regularised_rows"), 10);
  EXPECT_GT(text.metadata.at("regularised_beyond_deformation").size(), 3u);
  EXPECT_EQ(parse_table_text(lut_text(bare, Abscissa::area), "x").metadata.count("regularised_beyond_area_um2"), 0u);
}

TEST(LookupTable, TheEndsOfTheBranchesAreACurve) {
  const auto spec = spec_with({});
  const auto branches = invented_unstable_branches(spec);
  const auto table = make_lookup_table(spec, branches, "0");
  std::istringstream csv(end_of_branch_csv(table));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "radius_um,young_modulus_kPa,area_um2,deformation,volume_um3,least_meridional_stretch,status,reason");
  int ends = 0;
  while (std::getline(csv, line)) {
    EXPECT_TRUE(line.ends_with(",surface-unstable,\"the bare surface has lost its stability, it would wrinkle\""))
        << line;
    ++ends;
  }
  EXPECT_EQ(ends, std::ranges::count(branches, Status::surface_unstable, [](const auto& b) { return b.end.status; }));
}

TEST(LookupTable, TheEffectOfBendingIsListedWhereBothBranchesExist) {
  const auto spec = spec_with({});
  const auto branches = invented_unstable_branches(spec);
  std::istringstream csv(regularisation_csv(make_lookup_table(spec, branches, "0")));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "radius_um,young_modulus_kPa,area_um2,bending_kBT,deformation,deformation_held,relative_change");
  int lines = 0;
  for (; std::getline(csv, line); ++lines) {
    std::ranges::replace(line, ',', ' ');
    std::istringstream numbers(line);
    double radius = 0, stiffness = 0, area = 0, bending = 0, bare = 0, regularised = 0, change = 0;
    numbers >> radius >> stiffness >> area >> bending >> bare >> regularised >> change;
    EXPECT_TRUE(numbers) << line;
    EXPECT_EQ(bending, 1e4);
    // What bending does to the invented branches, up to the interpolation of the bare one.
    EXPECT_NEAR(regularised / bare, 1 - 1e-3, 1e-5);
    EXPECT_NEAR(change, regularised / bare - 1, 1e-5);
  }
  EXPECT_GE(lines, std::ranges::count(branches, 1e4, &SampledBranch::bending_kBT));
}

TEST(LookupTable, AllFilesAreEqualWhateverTheOrderOfTheBranches) {
  const auto spec = spec_with({});
  auto branches = invented_unstable_branches(spec), shuffled = branches;
  std::ranges::reverse(shuffled);
  for (auto& branch : shuffled) branch.seconds = 99;  // times must not reach any file
  const auto one = table_files(make_lookup_table(spec, branches, "0"));
  const auto two = table_files(make_lookup_table(spec, shuffled, "0"));
  ASSERT_EQ(one.size(), 8u);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].name, two[i].name);
    EXPECT_EQ(one[i].content, two[i].content) << one[i].name;
  }
}

TEST(LookupTable, TheTextHoldsUprightStaggeredColumnsAndAllParameters) {
  const auto spec = spec_with({});
  const auto branches = invented_branches(spec, 60);
  const auto table = make_lookup_table(spec, branches, "1.2.3");
  const auto area = parse_table_text(lut_text(table, Abscissa::area), "x");
  const auto volume = parse_table_text(lut_text(table, Abscissa::volume), "x");
  ASSERT_EQ(area.rows.size(), 6u * 30u + 6u * 31u);  // the whole rectangle, corners included
  for (std::size_t i = 0; i < area.rows.size(); ++i) {
    const auto& [size, d, stiffness] = area.rows[i];
    const std::size_t pair = i / 61 * 61, in_pair = i % 61;  // a column of 30 and one of 31
    EXPECT_EQ(size, area.rows[in_pair < 30 ? pair : pair + 30][0]);
    EXPECT_EQ(d, area.rows[in_pair][1]);
    if (in_pair > 30 && in_pair < 60) {  // ten digits
      EXPECT_NEAR(d, std::sqrt(area.rows[in_pair - 31][1] * area.rows[in_pair - 30][1]), 1e-9 * d);
    }
    // Polynomials through six of 12 radii.
    EXPECT_NEAR(stiffness / invented_modulus(size, d), 1, 2e-5);
  }
  EXPECT_EQ(area.rows.front()[0], 30);
  EXPECT_EQ(area.rows.back()[0], 290);
  EXPECT_GT(volume.rows.size(), table.rows.size());
  for (const auto& [size, d, stiffness] : volume.rows) {
    const double radius = std::cbrt(size * 3 / (4 * std::numbers::pi));
    EXPECT_NEAR(stiffness / invented_stiffness(radius, d), 1, 2e-6) << "cubic interpolation between 60 samples";
  }
  EXPECT_EQ(area.metadata.at("identifier"), "XX-2D-26");
  EXPECT_EQ(volume.metadata.at("identifier"), "XX-2D-26-volume");
  EXPECT_EQ(area.metadata.at("model"), "linear solid / newtonian fluid");
  EXPECT_EQ(area.metadata.at("software"), "rheocyte 1.2.3");
  EXPECT_EQ(area.metadata.at("case").at("flow").at("density_kg_per_m3"), 1000);
  EXPECT_FALSE(area.metadata.at("case").at("cell").contains("radius_um"));
}

TEST(LookupTable, BranchesWithoutStatesGiveFilesWithoutRows) {
  const auto spec = spec_with({});
  const std::vector<SampledBranch> branches(
      3, SampledBranch{5, 0, {}, {}, {}, {}, {}, {}, {Status::iteration_limit, "x"}});
  const auto files = table_files(make_lookup_table(spec, branches, "0"));
  EXPECT_NE(files.front().content.find("\"rows\": 0"), std::string::npos);
  EXPECT_EQ(std::ranges::count(end_of_branch_csv(make_lookup_table(spec, branches, "0")), '\n'), 1);
}

TEST(LookupTable, ShearThinningLiquidsHaveTheirWallViscosity) {
  const auto spec = parse_table_spec(
      short_spec, "spec.toml",
      std::vector<std::string>{"flow.law=power-law", "flow.consistency_Pa_sn=0.4057", "flow.exponent=0.6039"});
  // The value that the field states for the table HE-2D-FEM-22, four digits.
  EXPECT_NEAR(rheocyte::channel_flow_of(spec.base).viscosity_mPas, 6.056, 5e-4);
  EXPECT_EQ(table_metadata(spec, "0").at("fluid_flow_behaviour_index"), 0.6039);
}

TEST(LookupTable, LinesHaveTheirStiffnessAndFillThePlane) {
  const auto spec = spec_with({"table.radii=40"});
  const auto branches = invented_branches(spec, 60);
  const auto table = make_lookup_table(spec, branches, "0");
  const auto levels = line_levels(table);
  EXPECT_EQ(levels.size(), 11u);
  const auto lines = parse_table_text(lines_text(table, levels, Abscissa::area), "x");
  EXPECT_EQ(lines.metadata.at("lut identifier"), "XX-2D-26");
  EXPECT_FALSE(lines.metadata.contains("identifier"));
  for (const auto& [area, d, stiffness] : lines.rows) {
    EXPECT_NEAR(invented_modulus(area, d) / stiffness, 1, 2e-6);  // cubic interpolation between 60 samples
    EXPECT_NE(std::ranges::find(levels, stiffness), levels.end());
  }
  for (const double level : levels) EXPECT_GE(line_at(table, level).size(), 2u) << level;
  // Equal steps of E^-1/2, rounded to three digits.
  for (std::size_t i = 2; i < levels.size(); ++i) {
    const auto root = [&](std::size_t k) { return std::pow(levels[k], -0.5); };
    EXPECT_NEAR((root(i) - root(i - 1)) / (root(1) - root(0)), 1, 0.1);
  }
}

}  // namespace
}  // namespace rheocyte::lookup_table_test
