// Between the branches the stiffness is that of the closed form; where there is none, the reason is named.
#include "table/table_interpolation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "invented_branch.h"

namespace rheocyte::table_interpolation_test {
namespace {

using namespace test;

std::vector<Query> random_queries(const TableSpec& spec, int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> area(spec.min_area_um2, spec.max_area_um2),
      deformation(std::log(spec.min_deformation), std::log(spec.max_deformation));
  std::vector<Query> queries;
  for (int i = 0; i < count; ++i) queries.push_back({area(random), std::exp(deformation(random))});
  return queries;
}

TEST(TableInterpolation, IsExactBetweenTheBranchesOfASmoothTable) {
  const auto spec = spec_of_fifty_radii({});
  const auto branches = invented_branches(spec, 24);
  const TableInterpolation table(spec, branches);
  std::vector<double> errors;
  int within = 0;
  for (const auto& [area, d] : random_queries(spec, 2000)) {
    const auto answer = table.by_area(area, d);
    ASSERT_EQ(answer.reason, OutOfTable::none) << area << " " << d;
    errors.push_back(std::abs(answer.stiffness / invented_modulus(area, d) - 1));
    within += errors.back() <= answer.error;
    EXPECT_GT(answer.error, 4e-5);  // that of the states: half of 1e-4, because d ~ E^-2
    EXPECT_LT(answer.error, 1e-3);
  }
  std::ranges::sort(errors);
  EXPECT_LT(errors[1000], 1e-5);  // wanted are 1e-4; what remains is the cubic between 24 samples
  EXPECT_LT(errors.back(), 1e-4);
  EXPECT_EQ(within, 2000);
}

TEST(TableInterpolation, VolumesGiveTheSameAnswer) {
  const auto spec = spec_of_fifty_radii({});
  const auto branches = invented_branches(spec, 60);
  const TableInterpolation table(spec, branches);
  for (const auto& [area, d] : random_queries(spec, 200)) {
    const double radius = std::sqrt(area / (std::numbers::pi * (1 + 0.5 * d)));
    const auto answer = table.by_volume(4.0 / 3 * std::numbers::pi * std::pow(radius, 3), d);
    EXPECT_NEAR(answer.stiffness / invented_stiffness(radius, d), 1, 2e-6);  // the cubic between 60 samples
  }
}

TEST(TableInterpolation, RisesWithTheAreaAndFallsWithTheDeformation) {
  const auto spec = spec_of_fifty_radii({"table.radii=15"});
  const auto branches = invented_branches(spec);
  const TableInterpolation table(spec, branches);
  double last = 0;
  for (double area = 31; area < 289; area += 0.5) {
    const double stiffness = table.by_area(area, 0.03).stiffness;
    EXPECT_GT(stiffness, last);
    last = stiffness;
  }
  last = std::numeric_limits<double>::infinity();
  for (double d = 6e-5; d < 0.18; d *= 1.02) {
    const double stiffness = table.by_area(100, d).stiffness;
    EXPECT_LT(stiffness, last);
    last = stiffness;
  }
}

TEST(TableInterpolation, OutsideTheTableTheReasonIsNamed) {
  const auto spec = spec_of_fifty_radii({});
  const auto branches = invented_branches(spec);
  const TableInterpolation table(spec, branches);
  const auto reason = [&](double area, double d) { return name_of(table.by_area(area, d).reason); };
  EXPECT_EQ(reason(29.9, 0.01), "too-small");
  EXPECT_EQ(reason(290.1, 0.01), "too-large");
  EXPECT_EQ(reason(100, 4.9e-5), "too-stiff");
  EXPECT_EQ(reason(100, 0.191), "too-soft");
  EXPECT_EQ(reason(100, -0.01), "invalid");
  EXPECT_EQ(reason(std::nan(""), 0.01), "invalid");
  EXPECT_EQ(reason(100, std::numeric_limits<double>::infinity()), "invalid");
  EXPECT_TRUE(std::isnan(table.by_area(29.9, 0.01).stiffness));
  EXPECT_EQ(name_of(table.by_volume(10, 0.01).reason), "too-small");
  EXPECT_EQ(name_of(table.by_volume(1e5, 0.01).reason), "too-large");
}

TEST(TableInterpolation, BeyondTheEndOfTheBranchesTheSurfaceIsUnstable) {
  const auto with = spec_of_fifty_radii({"table.bending_beyond_kBT=1e4"}), without = spec_of_fifty_radii({});
  const auto branches = invented_unstable_branches(with);
  const TableInterpolation bare(without, branches), regularised(with, branches);
  int unstable = 0;
  for (const auto& [area, d] : random_queries(with, 2000)) {
    const auto one = bare.by_area(area, d), other = regularised.by_area(area, d);
    ASSERT_EQ(other.reason, OutOfTable::none) << area << " " << d;
    // Bending of 1e4 k_B T lowers these deformations by 1e-3, the stiffness by about as much.
    EXPECT_NEAR(other.stiffness / invented_modulus(area, d), 1, other.regularised ? 1.5e-3 : 2e-5);
    if (one.reason == OutOfTable::none) {
      EXPECT_FALSE(one.regularised);
      continue;
    }
    EXPECT_EQ(name_of(one.reason), "unstable");
    EXPECT_TRUE(other.regularised);
    ++unstable;
  }
  EXPECT_GT(unstable, 50);
}

TEST(TableInterpolation, ARadiusWithoutStatesIsBridgedAndATableWithoutStatesHasNoAnswer) {
  const auto spec = spec_of_fifty_radii({});
  auto branches = invented_branches(spec);
  branches[20] = SampledBranch{branches[20].radius_um, 0, {}, {}, {}, {}, {}, {}, {Status::iteration_limit, "nothing"}};
  const TableInterpolation table(spec, branches);
  const double area = invented_area(branches[20].radius_um, 0.02);
  EXPECT_NEAR(table.by_area(area, 0.02).stiffness / invented_modulus(area, 0.02), 1, 1e-5);
  EXPECT_EQ(name_of(TableInterpolation(spec, {}).by_area(100, 0.02).reason), "unresolved");
}

}  // namespace
}  // namespace rheocyte::table_interpolation_test
