// The grid of a table gives the answers of the branches; where there is none, the reason is named.
#include "table/stiffness_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "../refusal.h"
#include "case/user_error.h"
#include "invented_branch.h"
#include "table/checked_record.h"
#include "table/grid_from_branches.h"
#include "table/table_interpolation.h"

namespace rheocyte::stiffness_grid_test {
namespace {

using namespace test;

std::vector<Query> random_queries(const TableSpec& spec, int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> area(std::log(spec.min_area_um2), std::log(spec.max_area_um2)),
      deformation(std::log(spec.min_deformation), std::log(spec.max_deformation));
  std::vector<Query> queries;
  for (int i = 0; i < count; ++i) queries.push_back({std::exp(area(random)), std::exp(deformation(random))});
  return queries;
}

TEST(StiffnessGrid, IsTheClosedFormOfASmoothTable) {
  const auto spec = spec_of_fifty_radii({});
  const StiffnessGrid grid(make_stiffness_grid(spec, invented_branches(spec, 48), "test").value());
  double greatest = 0;
  for (const auto& [area, d] : random_queries(spec, 3000)) {
    const auto answer = grid.answer(area, d);
    ASSERT_EQ(answer.reason, OutOfTable::none) << area << " " << d;
    EXPECT_FALSE(answer.regularised);
    greatest = std::max(greatest, std::abs(std::exp(answer.log_stiffness) / invented_modulus(area, d) - 1));
    EXPECT_GT(answer.error, 4e-5) << "that of the states: half of 1e-4, because d ~ E^-2";
    EXPECT_LT(answer.error, 2e-4);
  }
  EXPECT_LT(greatest, 2e-6) << "cubics between 48 samples, 128 columns and 112 rows";
}

TEST(StiffnessGrid, WhereLargeCellsLeaveTheTableByTheirAreaItIsAccurateToTheLastColumn) {
  // Each of these branches ends at the first sample beyond the greatest area, at whatever deformation it has there.
  const auto spec = spec_of_fifty_radii({});
  std::vector<SampledBranch> branches;
  int number = 0;
  for (const double radius : sweep_radii_um(spec)) {
    InventedSweep sweep = covering(spec, radius, 48);
    const double area = (1.02 + 0.005 * (number++ % 4)) * spec.max_area_um2;
    const double exit = 2 * (area / invented_area(radius, 0) - 1);
    if (exit < spec.max_deformation)
      sweep.softest = invented_stiffness(radius, std::max(exit, 2 * spec.min_deformation));
    branches.push_back(invented_branch(radius, sweep));
  }
  const StiffnessGrid grid(make_stiffness_grid(spec, branches, "test").value());
  for (const auto& [area, d] : random_queries(spec, 20000)) {
    if (area < 0.9 * spec.max_area_um2) continue;
    const auto answer = grid.answer(area, d);
    ASSERT_EQ(answer.reason, OutOfTable::none) << area << " " << d;
    EXPECT_NEAR(std::exp(answer.log_stiffness) / invented_modulus(area, d), 1, 1e-5) << area << " " << d;
  }
}

TEST(StiffnessGrid, DerivativesAreThoseOfTheValues) {
  const auto with = spec_of_fifty_radii({"table.bending_beyond_kBT=1e4"});
  const StiffnessGrid grid(make_stiffness_grid(with, invented_unstable_branches(with), "test").value());
  const double step = 1e-5;
  int compared = 0;
  for (const auto& [area, d] : random_queries(with, 500)) {
    const auto here = grid.answer(area, d);
    const auto value = [&](double a, double b) { return grid.answer(area * std::exp(a), d * std::exp(b)); };
    const auto right = value(step, 0), left = value(-step, 0), up = value(0, step), down = value(0, -step);
    bool inside = true;
    for (const auto& answer : {here, right, left, up, down})
      inside = inside && answer.reason == OutOfTable::none && answer.regularised == here.regularised;
    if (!inside) continue;
    ++compared;
    EXPECT_NEAR(here.by_log_area, (right.log_stiffness - left.log_stiffness) / (2 * step), 1e-6);
    EXPECT_NEAR(here.by_log_deformation, (up.log_stiffness - down.log_stiffness) / (2 * step), 1e-6);
  }
  EXPECT_GT(compared, 450);
}

TEST(StiffnessGrid, OutsideTheTableTheReasonIsNamed) {
  const auto spec = spec_of_fifty_radii({});
  const StiffnessGrid grid(make_stiffness_grid(spec, invented_branches(spec), "test").value());
  const auto reason = [&](double area, double d) { return name_of(grid.answer(area, d).reason); };
  EXPECT_EQ(reason(29.9, 0.01), "too-small");
  EXPECT_EQ(reason(0, 0.01), "too-small");
  EXPECT_EQ(reason(290.1, 0.01), "too-large");
  EXPECT_EQ(reason(100, 4.9e-5), "too-stiff");
  EXPECT_EQ(reason(100, 0), "too-stiff");
  EXPECT_EQ(reason(100, 0.191), "too-soft");
  EXPECT_EQ(reason(std::nan(""), 0.01), "invalid");
  EXPECT_EQ(reason(100, std::nan("")), "invalid");
  EXPECT_EQ(reason(100, std::numeric_limits<double>::infinity()), "too-soft");
  EXPECT_TRUE(std::isnan(grid.answer(29.9, 0.01).log_stiffness));
}

TEST(StiffnessGrid, EndsAtTheInstabilityOrGoesOnWithBending) {
  const auto with = spec_of_fifty_radii({"table.bending_beyond_kBT=1e4"}), without = spec_of_fifty_radii({});
  const auto branches = invented_unstable_branches(with);
  const StiffnessGrid bare(make_stiffness_grid(without, branches, "test").value()),
      regularised(make_stiffness_grid(with, branches, "test").value());
  const TableInterpolation between(without, branches);
  int unstable = 0, lost = 0;
  for (const auto& [area, d] : random_queries(with, 3000)) {
    const auto one = bare.answer(area, d), other = regularised.answer(area, d);
    const auto exact = between.by_area(area, d);
    if (one.reason == OutOfTable::none) {
      // Lines of the grid bend with the border, a little more than the branches resolve.
      EXPECT_NEAR(std::exp(one.log_stiffness) / invented_modulus(area, d), 1, 5e-5) << area << " " << d;
      EXPECT_FALSE(other.regularised);
      continue;
    }
    EXPECT_EQ(name_of(one.reason), "unstable") << area << " " << d;
    ++unstable;
    lost += exact.reason == OutOfTable::none;
    if (other.reason != OutOfTable::none) continue;
    EXPECT_TRUE(other.regularised);
    // Bending of 1e4 k_B T lowers these deformations by 1e-3, the stiffness by about as much.
    EXPECT_NEAR(std::exp(other.log_stiffness) / invented_modulus(area, d), 1, 1.5e-3);
    EXPECT_GT(other.error, 3e-4) << "the step at the border is part of the error";
  }
  EXPECT_GT(unstable, 50);
  EXPECT_LT(lost, 30) << "the border is smoothed below the ends of the branches";
}

TEST(StiffnessGrid, JaggedEndsMakeNoWrongNumbers) {
  // Where ends jump from radius to radius, lines along the border do, too; polynomials along them go anywhere. Bending
  // and the jumps may cost accuracy, which the error must say.
  const auto spec = spec_of_fifty_radii({"table.bending_beyond_kBT=1e4"});
  const auto jagged = [](double radius) {
    const int k = static_cast<int>(radius / 0.13);
    return (radius < 5 ? 0.08 : radius < 6.4 ? 0.12 : invented_end(radius) + 0.05) * (1 + 0.1 * (k % 3 == 0));
  };
  const StiffnessGrid grid(make_stiffness_grid(spec, invented_unstable_branches(spec, jagged), "test").value());
  int regularised = 0;
  for (const auto& [area, d] : random_queries(spec, 20000)) {
    const auto answer = grid.answer(area, d);
    if (answer.reason != OutOfTable::none) continue;
    regularised += answer.regularised;
    const double off = std::abs(std::exp(answer.log_stiffness) / invented_modulus(area, d) - 1);
    EXPECT_LT(off, 0.02) << area << " " << d << " " << answer.regularised;
    EXPECT_LT(off, 3 * answer.error + 1e-4) << area << " " << d << " " << answer.regularised;
  }
  EXPECT_GT(regularised, 100);
}

TEST(StiffnessGrid, BranchesThatBendingHoldsCoverNoAreasButThoseOfTheBareOnes) {
  const auto spec = spec_of_fifty_radii({"table.bending_beyond_kBT=1e4"});
  auto branches = invented_unstable_branches(spec, [](double) { return 0.05; });
  // The bare branches of the largest cells lack their stiff end.
  const double last = sweep_radii_um(spec)[46];
  for (SampledBranch& branch : branches)
    if (branch.bending_kBT == 0 && branch.radius_um > last)
      branch = invented_branch(branch.radius_um, {.stiffest = invented_stiffness(branch.radius_um, 0.01),
                                                  .softest = branch.stiffness.back(),
                                                  .end = Status::surface_unstable});
  const GridContent grid = make_stiffness_grid(spec, branches, "test").value();
  ASSERT_EQ(grid.patches.size(), 2U);
  EXPECT_GE(grid.patches[1].first_column, 0);
  EXPECT_LE(grid.patches[1].first_column + grid.patches[1].columns, grid.columns);
  EXPECT_EQ(to_bytes(grid_from_bytes(to_bytes(grid), "grid")), to_bytes(grid));
}

TEST(StiffnessGrid, ABranchThatStopsShortBetweenOthersIsBridged) {
  const auto spec = spec_of_fifty_radii({});
  auto branches = invented_branches(spec);
  auto sweep = covering(spec, branches[20].radius_um);
  sweep.softest = invented_stiffness(branches[20].radius_um, 0.02);
  sweep.end = Status::accuracy_not_reached;
  branches[20] = invented_branch(branches[20].radius_um, sweep);
  branches[30] = SampledBranch{branches[30].radius_um, 0, {}, {}, {}, {}, {}, {}, {Status::iteration_limit, "nothing"}};
  const StiffnessGrid grid(make_stiffness_grid(spec, branches, "test").value());
  for (const std::size_t i : {20, 30}) {
    const double area = invented_area(branches[i].radius_um, 0.1);
    EXPECT_NEAR(std::exp(grid.answer(area, 0.1).log_stiffness) / invented_modulus(area, 0.1), 1, 3e-5);
  }
}

TEST(StiffnessGrid, AFewRadiiMakeACoarseGridAndOneMakesNone) {
  const auto spec = spec_of_fifty_radii({"table.radii=6"});
  const auto branches = invented_branches(spec);
  const StiffnessGrid grid(make_stiffness_grid(spec, branches, "test").value());
  for (const auto& [area, d] : random_queries(spec, 200)) {
    const auto answer = grid.answer(area, d);
    if (answer.reason != OutOfTable::none) continue;
    const double off = std::abs(std::exp(answer.log_stiffness) / invented_modulus(area, d) - 1);
    EXPECT_LT(off, 1e-2);
    EXPECT_LT(off, 3 * answer.error) << "a coarse table says that it is coarse";
  }
  EXPECT_FALSE(make_stiffness_grid(spec, std::span(branches).first(1), "test"));
  EXPECT_FALSE(make_stiffness_grid(spec, {}, "test"));
}

TEST(StiffnessGrid, IsTheSameFromItsFile) {
  const auto spec = spec_of_fifty_radii({"table.bending_beyond_kBT=1e4"});
  const auto content = make_stiffness_grid(spec, invented_unstable_branches(spec), "1.0").value();
  const auto bytes = to_bytes(content);
  EXPECT_LT(bytes.size(), 1U << 20);
  const auto back = grid_from_bytes(bytes, "grid.cbor");
  EXPECT_EQ(to_bytes(back), bytes);
  EXPECT_EQ(back.origin.identifier, "XX-2D-26");
  EXPECT_EQ(back.origin.model, "linear solid / newtonian fluid");
  EXPECT_EQ(back.origin.program, "rheocyte 1.0");
  EXPECT_EQ(back.origin.flow.exponent, 1);
  EXPECT_FALSE(back.origin.is_shell);
  EXPECT_EQ(to_toml(parse_table_spec(back.origin.spec, "grid")), to_toml(spec)) << "the spec is complete";
  const StiffnessGrid one(content), other(back);
  for (const auto& [area, d] : random_queries(spec, 100)) {
    const auto a = one.answer(area, d), b = other.answer(area, d);
    EXPECT_EQ(a.reason, b.reason);
    EXPECT_TRUE(std::abs(a.log_stiffness - b.log_stiffness) < 1e-6 || a.reason != OutOfTable::none)
        << "the file has single precision";
  }
}

TEST(StiffnessGrid, AFileOfFormerVersionsWithItsDoublesIsReadAsItIs) {
  const auto spec = spec_of_fifty_radii({});
  const auto content = make_stiffness_grid(spec, invented_branches(spec), "1.0", {8, 8, 4}).value();
  OpenedRecord opened = opened_record({"rheocyte grid", "2", "", ""}, to_bytes(content));
  nlohmann::json& patch = opened.record.at("patches").at(0);
  patch["log_stiffness"] = blob_of(content.patches[0].log_stiffness);
  const std::string old = sealed_record({"rheocyte grid", "1", "", ""}, opened.spec_hash, opened.record);
  EXPECT_EQ(grid_from_bytes(old, "grid.cbor").patches[0].log_stiffness, content.patches[0].log_stiffness);
  const std::string newer = sealed_record({"rheocyte grid", "3", "", ""}, opened.spec_hash, opened.record);
  EXPECT_NE(test::refusal_of([&] { grid_from_bytes(newer, "grid.cbor"); }).find("in format \"3\" and not 2"),
            std::string::npos);
}

TEST(StiffnessGrid, NumbersThatNoCellHasAreRefusedEvenUnderTheirChecksum) {
  const auto spec = spec_of_fifty_radii({});
  const auto good = make_stiffness_grid(spec, invented_branches(spec), "1.0", {8, 8, 4}).value();
  for (auto member : {&GridPatch::lower, &GridPatch::upper, &GridPatch::log_stiffness, &GridPatch::error}) {
    for (const double number : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e300, -1e300}) {
      auto bad = good;
      (bad.patches[0].*member)[3] = number;
      EXPECT_THROW(grid_from_bytes(to_bytes(bad), "grid.cbor"), UserError) << number;
    }
  }
  auto bad = good;
  bad.min_log_area = std::nan("");
  EXPECT_THROW(grid_from_bytes(to_bytes(bad), "grid.cbor"), UserError);
}

TEST(StiffnessGrid, ADamagedFileIsRefused) {
  const auto spec = spec_of_fifty_radii({});
  const auto bytes = to_bytes(make_stiffness_grid(spec, invented_branches(spec), "1.0", {8, 8, 4}).value());
  const auto refusal = [](const std::string& damaged) -> std::string {
    try {
      grid_from_bytes(damaged, "grid.cbor");
    } catch (const UserError& error) {
      return error.what();
    }
    return "none";
  };
  for (std::size_t at = 0; at < bytes.size(); at += at < 300 ? 1 : 37) {
    auto damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 8);
    EXPECT_NE(refusal(damaged).find("grid.cbor: this grid of a table cannot be used"), std::string::npos) << at;
    EXPECT_NE(refusal(bytes.substr(0, at)).find("cannot be used"), std::string::npos) << at;
  }
  EXPECT_NE(refusal(to_bytes(invented_branch(7), "0123456789abcdef")).find("it is not a rheocyte grid"),
            std::string::npos);
}

}  // namespace
}  // namespace rheocyte::stiffness_grid_test
