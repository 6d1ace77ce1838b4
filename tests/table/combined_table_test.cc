#include "table/combined_table.h"

#include <gtest/gtest.h>

#include <random>

#include "../refusal.h"
#include "case/user_error.h"
#include "invented_branch.h"
#include "invented_combined.h"
#include "invented_elongated_combined.h"
#include "table/combined_interpolation.h"

namespace rheocyte::combined_table_test {
namespace {

using namespace test;

/// The table with one number of its last row replaced.
std::string with_last_row(const std::string& csv, int column, const std::string& number) {
  std::size_t at = csv.rfind('\n', csv.size() - 2) + 1;
  for (int i = 0; i < column; ++i) at = csv.find(',', at) + 1;
  return csv.substr(0, at) + number + csv.substr(csv.find(',', at));
}

TEST(CombinedTable, ReadsBackToTheSameBits) {
  // Digits are the shortest that give the same number; columns that differ are named with their line.
  const CombinedTable table = invented_combined_table(std::vector<std::string>{"table.radii=2"});
  const std::string csv = combined_table_csv(table);
  const CombinedTable back = parse_combined_table(table.spec, csv, "combined.csv");
  ASSERT_EQ(back.branches.size(), table.branches.size());
  for (std::size_t i = 0; i < table.branches.size(); ++i) {
    EXPECT_EQ(back.branches[i].value, table.branches[i].value);
    EXPECT_EQ(back.branches[i].slope, table.branches[i].slope);
    EXPECT_EQ(back.branches[i].stiffness_kPa, table.branches[i].stiffness_kPa);
  }
  EXPECT_EQ(combined_table_csv(back), csv);
  for (const auto& [bad, words] : {std::pair(std::string("a,b\n1,2\n"), ":1: the columns"),
                                   std::pair(csv + "1,2,3\n", "another number of columns"),
                                   std::pair(csv + "1,x\n", "something else than numbers"),
                                   std::pair(with_last_row(csv, 1, "1.5"), "not those of a cell"),
                                   std::pair(with_last_row(csv, 8, "-3"), "not those of a cell"),
                                   std::pair(with_last_row(csv, 4, "3"), "not those of this stiffness"),
                                   std::pair(with_last_row(csv, 0, "7.77"), "not those of this stiffness")}) {
    try {
      parse_combined_table(table.spec, bad, "combined.csv");
      FAIL() << words;
    } catch (const UserError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
}

TEST(CombinedTable, AsOneFileItGivesBackTheSameBitsAndDamageIsRefusedInASentence) {
  CombinedTable table = invented_combined_table(std::vector<std::string>{"table.radii=2"});
  const std::string bytes = to_bytes(table);
  const CombinedTable back = combined_from_bytes(bytes, "combined.cbor");
  EXPECT_EQ(combined_table_csv(back), combined_table_csv(table));
  EXPECT_EQ(to_toml(back.spec), to_toml(table.spec));
  std::string cut = bytes, changed = bytes;
  cut.resize(bytes.size() / 2);
  changed[bytes.size() / 3] = char(changed[bytes.size() / 3] ^ 1);
  for (const std::string& damaged : {cut, changed, std::string("no table")})
    EXPECT_NE(
        refusal_of([&] { combined_from_bytes(damaged, "combined.cbor"); }).find("combined.cbor: this combined table"),
        std::string::npos);
  table.branches.back().stiffness_kPa[1] = 2 * table.branches.back().stiffness_kPa[0];
  EXPECT_NE(refusal_of([&] { combined_from_bytes(to_bytes(table), "combined.cbor"); }).find("stiffness does not fall"),
            std::string::npos);
}

TEST(CombinedTable, HoldsTheModesOfTheContours) {
  // Those of an ellipse-like contour, with slopes against differences of the contour: both are exact to 1e-4 of c2 ~ d.
  auto branch = invented_branch(7);
  branch.cortex_fraction = 0.25;
  TableSpec spec;
  const auto combined = make_combined_table(spec, std::vector{branch}).branches.at(0);
  const int i = branch.samples() - 3;
  const double d = branch.at(i, Measure::deformation), step = 1e-5;
  const auto c2 = [&](double deformation) {
    return outline_shape(mirrored(invented_contour(7, deformation))).modes[0];
  };
  EXPECT_EQ(combined.value(i, int(ShapeFeature::first_mode)), c2(d));
  const double slope = (c2(d + step) - c2(d - step)) / (2 * step) * branch.slope(i, int(Measure::deformation));
  EXPECT_NEAR(combined.slope(i, int(ShapeFeature::first_mode)) / slope, 1, 1e-4);
  EXPECT_EQ(combined.value(i, int(ShapeFeature::area_um2)), branch.at(i, Measure::area_um2));
}

class Interpolation : public testing::Test {
 protected:
  CombinedInterpolation between_{whole_combined_table()};
  std::mt19937 engine_{1};

  /// Anywhere in the box but near its ends of the deformation.
  CellCoordinates random_cell() {
    CellCoordinates cell;
    for (int i = 0; i < coordinate_count; ++i)
      cell(i) = std::uniform_real_distribution(between_.box().least(i), between_.box().greatest(i))(engine_);
    cell(x_progress) = std::uniform_real_distribution(std::log(2e-3), std::log(0.05))(engine_);
    return cell;
  }
};

TEST_F(Interpolation, BetweenTheBranchesItIsTheInventedCell) {
  // The stiffness at a deformation leads to a cell of this deformation, area, moments and modes: 16 samples, 7 radii
  // and 5 fractions of smooth functions leave less than 1e-3 in the middle and three times as much near the borders.
  for (int trial = 0; trial < 50; ++trial) {
    const CellCoordinates cell = random_cell();
    const CombinedState state = between_.at(cell);
    EXPECT_TRUE(state.inside);
    const ShapeVector exact = invented_features({std::exp(cell(0)), cell(1), cell(3)}, std::exp(state.value(0)));
    EXPECT_NEAR(std::log(exact(1)), cell(2), 3e-3) << cell.transpose();
    EXPECT_NEAR(state.value(log_area_row), exact(0), 3e-4);
    for (int f = 2; f < feature_count; ++f) EXPECT_NEAR(state.value(f), exact(f), 3e-4) << f;
  }
}

TEST_F(Interpolation, GradientsAreThoseOfTheValues) {
  // Central differences, 1e-5 in each coordinate: 1e-6 of error where the cubics have a jump in their curvature.
  for (int trial = 0; trial < 20; ++trial) {
    const CellCoordinates cell = random_cell();
    const CombinedState state = between_.at(cell);
    for (int x = 0; x < coordinate_count; ++x) {
      const CellCoordinates step = 1e-5 * CellCoordinates::Unit(x);
      const auto difference = ((between_.at(cell + step).value - between_.at(cell - step).value) / 2e-5).eval();
      EXPECT_LT((state.gradient.col(x) - difference).cwiseAbs().maxCoeff(), 1e-4) << x;
    }
  }
}

TEST_F(Interpolation, TheWeightsOfTheBranchesAreThoseOfTheState) {
  // They sum to one and give back radius and fraction of the cell, to the rounding of 64 terms.
  const CombinedTable& table = whole_combined_table();
  for (int trial = 0; trial < 20; ++trial) {
    const CellCoordinates cell = random_cell();
    double sum = 0, log_radius = 0, fraction = 0;
    for (const auto& [branch, weight, stiffness] : between_.weights(cell)) {
      const SweepPoint& place = table.branches.at(std::size_t(branch)).place;
      sum += weight;
      log_radius += weight * std::log(place.radius_um);
      fraction += weight * place.cortex_fraction;
    }
    EXPECT_NEAR(sum, 1, 1e-10);
    EXPECT_NEAR(log_radius, cell(0), 1e-10);
    EXPECT_NEAR(fraction, cell(1), 1e-10);
  }
  EXPECT_TRUE(between_.weights(between_.box().greatest + CellCoordinates::Ones()).empty());
}

TEST_F(Interpolation, NothingJumpsWhereABranchEnds) {
  // Some branches end early, one is missing. Along straight lines through the table no value changes from step to step
  // by more than its slopes say.
  CombinedTable table = whole_combined_table();
  std::erase_if(table.branches,
                [](const CombinedBranch& b) { return b.place.radius_um == 7.0 && b.place.cortex_fraction == 0.5; });
  for (std::size_t i = 0; i < table.branches.size(); i += 5) {
    CombinedBranch& branch = table.branches[i];
    const int samples = branch.samples() - 4;
    branch.stiffness_kPa.resize(std::size_t(samples));
    branch.value.conservativeResize(samples, Eigen::NoChange);
    branch.slope.conservativeResize(samples, Eigen::NoChange);
  }
  const CombinedInterpolation shortened(table);
  for (int trial = 0; trial < 30; ++trial) {
    const CellCoordinates start = random_cell(), way = random_cell() - start;
    constexpr int steps = 3000;
    CombinedState last = shortened.at(start);
    for (int i = 1; i <= steps; ++i) {
      const CombinedState state = shortened.at(start + double(i) / steps * way);
      const auto change = (state.value - last.value).cwiseAbs().eval();
      const auto expected = ((state.gradient + last.gradient) / 2 * way / steps).cwiseAbs().eval();
      EXPECT_LT((change - expected).maxCoeff(), 2e-5) << trial << ' ' << i;
      last = state;
    }
  }
}

TEST_F(Interpolation, ACellBeyondTheBranchesIsSaid) {
  // Softer than all, larger than all; the values go on nevertheless.
  CellCoordinates cell = random_cell();
  cell(x_progress) = std::log(0.5);
  EXPECT_FALSE(between_.at(cell).inside);
  EXPECT_TRUE(between_.at(cell).value.allFinite());
  cell = random_cell();
  cell(x_radius) = std::log(15.0);
  EXPECT_FALSE(between_.at(cell).inside);
}

TEST(ElongatedTable, HasAColumnOfTheAxialRatio) {
  // And reads back to the same bits; a table of round cells has none.
  const CombinedTable& table = whole_elongated_table();
  const std::string csv = combined_table_csv(table);
  EXPECT_TRUE(csv.starts_with("radius_um,cortex_fraction,tension_ratio,axial_ratio,stiffness_kPa"));
  const CombinedTable back = parse_combined_table(table.spec, csv, "combined.csv");
  ASSERT_EQ(back.branches.size(), table.branches.size());
  for (std::size_t i = 0; i < table.branches.size(); ++i) {
    EXPECT_EQ(back.branches[i].place.axial_ratio, table.branches[i].place.axial_ratio);
    EXPECT_EQ(back.branches[i].value, table.branches[i].value);
  }
  EXPECT_EQ(combined_table_csv(back), csv);
  EXPECT_EQ(combined_table_csv(invented_combined_table(std::vector<std::string>{"table.radii=2"})).find("axial"),
            std::string::npos);
}

/// Anywhere inside an elongated table.
CellCoordinates random_elongated_cell(const CombinedInterpolation& between, std::mt19937& engine) {
  CellCoordinates cell;
  for (int i = 0; i < coordinate_count; ++i)
    cell(i) = std::uniform_real_distribution(between.box().least(i), between.box().greatest(i))(engine);
  cell(x_progress) = std::uniform_real_distribution(std::log(0.02), std::log(0.05))(engine);
  return cell;
}

TEST(ElongatedTable, BetweenTheBranchesItIsTheInventedCell) {
  // The stiffness at a place along the branches leads to a cell of this third mode at every tension: cubics through
  // five radii, four fractions and five axial ratios leave 2e-3 of it, and 5e-4 in the others.
  const CombinedInterpolation between(whole_elongated_table());
  std::mt19937 engine(2);
  for (int trial = 0; trial < 50; ++trial) {
    const CellCoordinates cell = random_elongated_cell(between, engine);
    const CombinedState state = between.at(cell);
    EXPECT_TRUE(state.inside);
    const SweepPoint place{std::exp(cell(0)), cell(1), cell(3), cell(4)};
    const ShapeVector exact = invented_elongated_features(place, std::exp(state.value(log_stiffness_row)));
    EXPECT_NEAR(state.value(first_mode_row + 1) / exact(int(ShapeFeature::first_mode) + 1), 1, 2e-3)
        << cell.transpose();
    EXPECT_NEAR(state.value(log_area_row), exact(0), 5e-4);
    EXPECT_NEAR(state.value(deformation_row), exact(1), 5e-4);
    for (int f = 2; f < feature_count; ++f) EXPECT_NEAR(state.value(f), exact(f), 5e-4) << f;
  }
}

TEST(ElongatedTable, GradientsAreThoseOfTheValues) {
  // Central differences, as for round cells.
  const CombinedInterpolation between(whole_elongated_table());
  std::mt19937 engine(3);
  for (int trial = 0; trial < 20; ++trial) {
    const CellCoordinates cell = random_elongated_cell(between, engine);
    const CombinedState state = between.at(cell);
    for (int x = 0; x < coordinate_count; ++x) {
      const CellCoordinates step = 1e-5 * CellCoordinates::Unit(x);
      const auto difference = ((between.at(cell + step).value - between.at(cell - step).value) / 2e-5).eval();
      EXPECT_LT((state.gradient.col(x) - difference).cwiseAbs().maxCoeff(), 1e-4) << x;
    }
  }
}

TEST(CombinedSpec, FractionsAndTensionsMakeTheSweep) {
  // Radius by radius; cells without a cortex once, pure ones without the other law; it reads back from its own text.
  const TableSpec spec = parse_table_spec(combined_spec, "spec.toml");
  EXPECT_TRUE(spec.is_combined());
  const auto places = sweep_places(spec);
  EXPECT_EQ(places.size(), 9u * (7 + 6 + 6));
  const Case both = case_at(spec, {8, 0.25, 0.15}, 4), bulk = case_at(spec, {8, 0, 0.15}, 4),
             shell = case_at(spec, {8, 1, 0.3}, 4);
  EXPECT_EQ(both.cell.bulk.young_modulus_kPa, 3);
  EXPECT_EQ(both.cell.cortex.modulus_mN_per_m, 8);
  EXPECT_EQ(both.cell.cortex.tension_ratio, 0.15);
  EXPECT_EQ(both.cell.cortex.bending_kBT, 1e4);
  EXPECT_EQ(bulk.cell.cortex.law, CortexLaw::none);
  EXPECT_EQ(bulk.cell.bulk.young_modulus_kPa, 4);
  EXPECT_EQ(shell.cell.bulk.law, BulkLaw::none);
  EXPECT_EQ(shell.cell.cortex.modulus_mN_per_m, 32);
  EXPECT_EQ(to_toml(parse_table_spec(to_toml(spec), "again")), to_toml(spec));
}

TEST(CombinedSpec, WhatDoesNotGoTogetherIsRefused) {
  // One sentence each, with the key.
  const auto refuse = [](const std::vector<std::string>& settings, const std::string& words) {
    try {
      parse_table_spec(combined_spec, "spec.toml", settings);
      FAIL() << words;
    } catch (const UserError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  refuse({"table.cortex_fraction=[0, 2]"}, "table.cortex_fraction contains 2, which is outside its range");
  refuse({"table.cortex_fraction=[0.5, 0]"}, "must ascend");
  refuse({"table.cortex_fraction=[0.5]"}, "at least two fractions");
  refuse({"table.cortex_fraction=0.5"}, "is not a list of numbers");
  refuse({"table.stiffness=cell.bulk.young_modulus_kPa"}, "does not go with table.cortex_fraction");
  refuse({"cell.bulk.law=none"}, "needs a law of the bulk and one of the cortex");
  refuse({"cell.bulk.young_modulus_kPa=3"}, "because a table sweeps it");
  refuse({"cell.cortex.tension_ratio=0.1"}, "exclude each other");
  refuse({"cell.cortex.tension_mN_per_m=0.1"}, "does not go with table.cortex_fraction");
  refuse({"table.bending_beyond_kBT=1e5"}, "has no effect on combined cells");
}

}  // namespace
}  // namespace rheocyte::combined_table_test
