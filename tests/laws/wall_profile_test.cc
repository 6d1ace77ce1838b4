// The wall goes through its table, smoothly and without overshooting.
#include "laws/wall_profile.h"

#include <gtest/gtest.h>

namespace rheocyte::wall_profile_test {
namespace {

const WallTable table{{-1, 0, 1.5, 4, 5}, {2, 2, 1.4, 1, 1}};

TEST(WallProfile, MeetsItsTableAndIsConstantBeyond) {
  const WallProfile wall(table);
  for (std::size_t i = 0; i < table.x.size(); ++i) EXPECT_NEAR(wall.radius(table.x[i]), table.radius[i], 1e-15);
  EXPECT_EQ(wall.radius(-100), 2);
  EXPECT_EQ(wall.radius(100), 1);
}

TEST(WallProfile, IsMonotonicAndHasNoKink) {
  // Never wider behind; the slopes on both sides of every place agree to the step of the difference.
  const WallProfile wall(table);
  for (double x = -2; x < 6; x += 0.01) EXPECT_LE(wall.radius(x + 0.01), wall.radius(x) + 1e-15);
  constexpr double h = 1e-6;
  for (const double x : table.x)
    EXPECT_NEAR((wall.radius(x + h) - wall.radius(x)) / h, (wall.radius(x) - wall.radius(x - h)) / h, 1e-5);
}

TEST(WallProfile, ATableOfOneRadiusIsStraight) {
  const WallProfile wall({{0, 1, 3}, {1, 1, 1}});
  for (double x = -1; x < 4; x += 0.013) EXPECT_NEAR(wall.radius(x), 1, 3e-16);
}

TEST(WallProfile, TwoPlacesMakeTheSmoothStep) {
  // Level at both ends: 3 s^2 - 2 s^3 in between.
  const WallProfile wall({{0, 2}, {2, 1}});
  for (double s = 0; s <= 1; s += 0.1) EXPECT_NEAR(wall.radius(2 * s), 2 - s * s * (3 - 2 * s), 1e-15);
}

TEST(WallProfile, RoundedCornersLieBetweenTheLinesAndAreNearWhereTheyMeet) {
  // In a contraction of slope s a corner is off the lines by s e ln 2, and by less than 1e-4 of s e after 10 e.
  const double e = 0.3;
  const WallTable lines{{-4, 0}, {5, 1}, e};
  const WallProfile wall(lines);
  EXPECT_NEAR(wall.radius(0), 1 + e * std::log(2), 1e-5);
  EXPECT_NEAR(wall.radius(-4), 5 - e * std::log(2), 1e-5);
  EXPECT_NEAR(wall.radius(-2), 3, 1e-12);  // half way, by symmetry
  for (double x = -20; x < 20; x += 0.1) {
    EXPECT_LE(wall.radius(x + 0.1), wall.radius(x) + 1e-14);
    EXPECT_GE(wall.radius(x), 1 - 1e-14);
    EXPECT_LE(wall.radius(x), 5);
  }
  EXPECT_NEAR(wall.radius(last_change(lines)), 1, 1.1e-4);
  EXPECT_NEAR(wall.radius(1e3), 1, 1e-12);
}

}  // namespace
}  // namespace rheocyte::wall_profile_test
