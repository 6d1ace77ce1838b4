// Checks of a measure: of all events, and of each third of the areas.
#include "experiment/measure_check.h"

#include <gtest/gtest.h>

#include "numeric/cell_random.h"

namespace rheocyte::measure_check_test {
namespace {

/// Normally distributed values that go with the area by a slope.
CheckedValues values(int count, std::uint64_t seed, double slope, double shift = 0) {
  CheckedValues all;
  for (int i = 0; i < count; ++i) {
    CellRandom random(seed, std::uint64_t(i), Purpose::population);
    const double area = random.normal();
    all.log_area.push_back(area);
    all.values.push_back(shift + slope * area + random.normal());
  }
  return all;
}

/// By chance one of 70 does not: 1 % of all events together, 0.1 % of each third.
TEST(MeasureCheck, EqualDistributionsFitInAllThirds) {
  int misfits = 0;
  const CheckedValues predicted = values(10'000, 99, 0.5);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    misfits += !compared_measure("c4", MeasureRule::of_all_real_cells, values(500, seed, 0.5), predicted).fits;
    misfits += !compared_measure("d", MeasureRule::not_fitted, values(500, seed, 0.5), predicted).fits;
  }
  EXPECT_LE(misfits, 2);
}

/// The measure itself is distributed alike.
TEST(MeasureCheck, WhatDoesNotGoWithTheSizeAsPredictedShowsInTheThirds) {
  const MeasureCheck check =
      compared_measure("c3", MeasureRule::not_fitted, values(3000, 1, 0.6), values(20'000, 2, -0.6));
  EXPECT_TRUE(check.fits_together);
  EXPECT_FALSE(check.fits);
  ASSERT_EQ(check.thirds.size(), 3U);
  EXPECT_FALSE(check.thirds[0].fits);
  EXPECT_TRUE(check.thirds[1].fits);
  EXPECT_FALSE(check.thirds[2].fits);
  EXPECT_NEAR(double(check.thirds[0].events), 1000, 2);
  EXPECT_NE(check_text({check}).find("does not fit: c3 of the smallest third is -0."), std::string::npos)
      << check_text({check});
}

TEST(MeasureCheck, AShiftOfAllIsToldOfAll) {
  const MeasureCheck check =
      compared_measure("d", MeasureRule::not_fitted, values(1000, 1, 0, 1), values(10'000, 2, 0));
  EXPECT_FALSE(check.fits_together);
  EXPECT_NE(check_text({check}).find("does not fit: d is 1"), std::string::npos) << check_text({check});
}

/// Masks of another convention move all values alike; what is moved further still shows.
TEST(MeasureCheck, WhatTheConventionOfTheMasksMovesIsNoMisfit) {
  const CheckedValues predicted = values(10'000, 2, 0);
  for (const double shift : {-0.4, 0.4}) {
    const CheckedValues measured = values(2000, 1, 0, shift);
    EXPECT_FALSE(compared_measure("d", MeasureRule::not_fitted, measured, predicted).fits);
    EXPECT_TRUE(compared_measure("d", MeasureRule::not_fitted, measured, predicted, 0.4).fits);
    EXPECT_FALSE(compared_measure("d", MeasureRule::not_fitted, measured, predicted, 0.1).fits);
  }
}

TEST(MeasureCheck, FewEventsHaveNoThirds) {
  const MeasureCheck check = compared_measure("d", MeasureRule::not_fitted, values(60, 1, 0), values(10'000, 2, 0));
  EXPECT_TRUE(check.thirds.empty());
  EXPECT_TRUE(check.fits);
}

}  // namespace
}  // namespace rheocyte::measure_check_test
