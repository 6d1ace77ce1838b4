// Of a smooth table few branches are computed, and the others are what they would have been.
#include "table/radius_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "invented_branch.h"

namespace rheocyte::radius_plan_test {
namespace {

using namespace test;

TableSpec spec_of_hundred_radii(const std::string& setting = "table.bending_beyond_kBT=0") {
  return parse_table_spec(short_spec, "spec.toml", std::vector<std::string>{"table.radii=100", setting});
}

/// Invented branches that a plan asks for, kept in memory.
class Computed {
 public:
  explicit Computed(const std::vector<SampledBranch>& branches, const TableSpec& spec) {
    const auto radii = sweep_radii_um(spec);
    for (const auto& branch : branches) {
      const auto place = std::ranges::find(radii, branch.radius_um) - radii.begin();
      all_[{static_cast<int>(place), branch.bending_kBT > 0}] = std::make_shared<SampledBranch>(branch);
    }
  }
  RadiusPlan plan(const TableSpec& spec) {
    return {spec, [this](const BranchTask& task) { return done_.contains(task) ? all_.at(task) : nullptr; }};
  }
  /// Finishes the missing branches one by one, from either end of the list.
  void complete(RadiusPlan& plan, bool from_behind = false) {
    while (!plan.update()) {
      ASSERT_FALSE(plan.missing().empty());
      const BranchTask task = from_behind ? plan.missing().back() : plan.missing().front();
      ASSERT_TRUE(all_.contains(task)) << task.place;
      ASSERT_TRUE(done_.insert(task).second) << task.place << " is asked for twice";
    }
  }
  const SampledBranch& at(const BranchTask& task) const { return *all_.at(task); }
  const std::set<BranchTask>& done() const { return done_; }

 private:
  std::map<BranchTask, RadiusPlan::Branch> all_;
  std::set<BranchTask> done_;
};

TEST(RadiusPlan, OfASmoothTableTheFirstRadiiAreEnough) {
  // Stiffness, area and contour of each left-out branch, at its own samples, are those of the closed form to 5e-6: the
  // polynomials between 24 samples.
  const auto spec = spec_of_hundred_radii();
  Computed computed(invented_branches(spec), spec);
  RadiusPlan plan = computed.plan(spec);
  computed.complete(plan);
  EXPECT_EQ(computed.done().size(), 11U);
  for (int i = 0; i < 100; ++i) {
    const auto branch = plan.branch({i, false});
    ASSERT_TRUE(branch);
    EXPECT_NEAR(branch->radius_um, sweep_radii_um(spec)[std::size_t(i)], 1e-12);
    EXPECT_LE(branch->at(0, Measure::deformation), spec.min_deformation);
    EXPECT_GE(branch->at(branch->samples() - 1, Measure::deformation), spec.max_deformation);
    for (int k = 0; k < branch->samples(); ++k) {
      const double d = branch->at(k, Measure::deformation), stiffness = branch->stiffness[std::size_t(k)];
      EXPECT_NEAR(stiffness / invented_stiffness(branch->radius_um, d), 1, 5e-6) << i << " " << d;
      EXPECT_NEAR(branch->at(k, Measure::area_um2) / invented_area(branch->radius_um, d), 1, 5e-6);
      const auto contour = invented_contour(branch->radius_um, d);
      EXPECT_LT((branch->contour[std::size_t(k)] - contour).norm(), 5e-6 * contour.norm());
    }
  }
}

TEST(RadiusPlan, BetweenItsSamplesALeftOutBranchIsAccurate) {
  // Values and slopes together: the polynomials in the middles of the samples.
  const auto spec = spec_of_hundred_radii();
  Computed computed(invented_branches(spec), spec);
  RadiusPlan plan = computed.plan(spec);
  computed.complete(plan);
  for (int i = 0; i < 100; ++i) {
    const auto branch = plan.branch({i, false});
    for (int k = 1; k < branch->samples(); ++k) {
      const double stiffness = std::sqrt(branch->stiffness[std::size_t(k) - 1] * branch->stiffness[std::size_t(k)]);
      const double d = interpolate(*branch, Measure::deformation, stiffness);
      EXPECT_NEAR(d / invented_deformation(branch->radius_um, stiffness), 1, 5e-6) << i << " " << d;
    }
  }
}

TEST(RadiusPlan, WhereTheKindOfEndChangesTheNeighboursAreComputed) {
  // No branch is interpolated between one that loses stability and one that does not.
  const auto spec = spec_of_hundred_radii("table.bending_beyond_kBT=1e4");
  Computed computed(invented_unstable_branches(spec), spec);
  RadiusPlan plan = computed.plan(spec);
  computed.complete(plan);
  const auto is_unstable = [&](int i) { return plan.branch({i, false})->end.status == Status::surface_unstable; };
  for (int i = 0; i < 100; ++i) {
    const auto own = plan.branch({i, false}), regularised = plan.branch({i, true});
    ASSERT_TRUE(own && regularised);
    EXPECT_EQ(own->end.status, computed.at({i, false}).end.status) << i;
    EXPECT_EQ(regularised->empty(), !is_unstable(i)) << i;
    if (!is_unstable(i)) continue;
    EXPECT_NEAR(own->at(own->samples() - 1, Measure::deformation), invented_end(own->radius_um), 1e-4);
    EXPECT_EQ(regularised->bending_kBT, 1e4);
    if (i + 1 == 100 || is_unstable(i + 1)) continue;
    EXPECT_TRUE(computed.done().contains({i, false}) && computed.done().contains({i + 1, false})) << i;
  }
  EXPECT_LT(computed.done().size(), 60U) << "of 150";
}

TEST(RadiusPlan, WhereBranchesJumpAllOfThemAreComputed) {
  // A step of 1 % in the stiffness: no polynomial across it.
  const auto spec = spec_of_hundred_radii();
  auto branches = invented_branches(spec);
  for (std::size_t i = 41; i < branches.size(); ++i)
    for (double& stiffness : branches[i].stiffness) stiffness *= 1.01;
  Computed computed(branches, spec);
  RadiusPlan plan = computed.plan(spec);
  computed.complete(plan);
  for (const int i : {39, 40, 41, 42}) EXPECT_TRUE(computed.done().contains({i, false})) << i;
}

TEST(RadiusPlan, TheOrderInWhichBranchesAreFinishedDoesNotMatter) {
  const auto spec = spec_of_hundred_radii("table.bending_beyond_kBT=1e4");
  const auto branches = invented_unstable_branches(spec);
  Computed one(branches, spec), other(branches, spec);
  RadiusPlan first = one.plan(spec), second = other.plan(spec);
  one.complete(first);
  other.complete(second, true);
  EXPECT_EQ(one.done(), other.done());
  for (int i = 0; i < 100; ++i)
    for (const bool regularised : {false, true})
      EXPECT_EQ(to_bytes(*first.branch({i, regularised}), "x"), to_bytes(*second.branch({i, regularised}), "x"))
          << i << regularised;
}

TEST(RadiusPlan, InASquareChannelAllBranchesAreHeldOrNone) {
  // Polynomials run through the branches of all radii: held ones of some radii alone would be of no use.
  const auto spec = parse_table_spec(
      short_spec, "spec.toml",
      std::vector<std::string>{"channel.section=square", "table.max_area_um2=260", "table.bending_beyond_ratio=3e-5"});
  const auto radii = computed_radii_um(spec);
  for (const bool is_one_unstable : {false, true}) {
    int asked = 0;
    RadiusPlan plan(spec, [&](const BranchTask& task) -> RadiusPlan::Branch {
      InventedSweep sweep = covering(spec, radii[std::size_t(task.place)]);
      sweep.end = is_one_unstable && task.place == 2 ? Status::surface_unstable : Status::covered;
      sweep.bending = task.regularised ? 1e4 : 0;
      asked += task.regularised;
      return std::make_shared<SampledBranch>(invented_branch(radii[std::size_t(task.place)], sweep));
    });
    EXPECT_TRUE(plan.update());
    EXPECT_EQ(asked, is_one_unstable ? std::ssize(radii) : 0);
    for (int i = 0; i < std::ssize(radii); ++i) EXPECT_EQ(plan.branch({i, true})->empty(), !is_one_unstable);
  }
}

TEST(RadiusPlan, InASquareChannelOneUnstableBranchTellsThatAllAreHeldBeforeTheOthersAreKnown) {
  const auto spec = parse_table_spec(
      short_spec, "spec.toml",
      std::vector<std::string>{"channel.section=square", "table.max_area_um2=260", "table.bending_beyond_ratio=3e-5"});
  const auto radii = computed_radii_um(spec);
  RadiusPlan plan(spec, [&](const BranchTask& task) -> RadiusPlan::Branch {
    if (task.regularised || task.place == 3) return nullptr;
    InventedSweep sweep = covering(spec, radii[std::size_t(task.place)]);
    sweep.end = task.place == 2 ? Status::surface_unstable : Status::covered;
    return std::make_shared<SampledBranch>(invented_branch(radii[std::size_t(task.place)], sweep));
  });
  EXPECT_FALSE(plan.update());
  const auto& missing = plan.missing();
  ASSERT_EQ(missing.size(), radii.size() + 1);
  EXPECT_EQ(missing.front(), (BranchTask{3, false}));
  for (int i = 0; i < std::ssize(radii); ++i) EXPECT_EQ(missing[std::size_t(i) + 1], (BranchTask{i, true}));
}

}  // namespace
}  // namespace rheocyte::radius_plan_test
