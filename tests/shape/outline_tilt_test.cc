// How outlines lie to the flow.
#include "shape/outline_tilt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "shape/outline_shape.h"

namespace rheocyte::outline_tilt_test {
namespace {

constexpr double pi = std::numbers::pi;

/// r(theta) with these modes, turned by an angle and moved.
Polygon outline(double c2, double c3, double angle, double sign = 1) {
  std::vector<Eigen::Vector2d> corners;
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i) {
    const double theta = 2 * pi * i / n, r = 1 + c2 * std::cos(2 * theta) + c3 * std::cos(3 * theta);
    corners.emplace_back(3 + sign * r * std::cos(theta + angle), 7 + r * std::sin(theta + angle));
  }
  if (sign < 0) std::reverse(corners.begin(), corners.end());
  Polygon polygon;
  polygon.assign(corners);
  return polygon;
}

OutlineTilt tilt_of(const Polygon& hull, int direction = 1) {
  return outline_tilt(hull, hull_asymmetry(hull).sine_modes, direction);
}

TEST(OutlineTilt, ATiltedEllipseHasTheSineModeOfItsAngle) {
  // r^-2 = cos^2/a^2 + sin^2/b^2 about the centre; turned, (c_2, s_2) is the mode of the ellipse that lies flat, turned
  // by twice the angle, and the midline of an ellipse is the line through its leftmost and rightmost points: with A =
  // cos^2/a^2 + sin^2/b^2 of x^2 ... its slope is (a^2 - b^2) sin cos / (a^2 cos^2 + b^2 sin^2).
  constexpr double a = 1.3, b = 0.9;
  for (const double angle : {0.0, 0.1, -0.4}) {
    std::vector<Eigen::Vector2d> corners;
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) {
      const double t = 2 * pi * i / n, x = a * std::cos(t), y = b * std::sin(t);
      corners.emplace_back(x * std::cos(angle) - y * std::sin(angle), x * std::sin(angle) + y * std::cos(angle));
    }
    Polygon ellipse;
    ellipse.assign(corners);
    const HullAsymmetry shape = hull_asymmetry(ellipse);
    const OutlineTilt tilt = tilt_of(ellipse);
    EXPECT_NEAR(std::atan2(tilt.sine_mode_2, shape.mode_2) / 2, angle, 1e-6);
    EXPECT_NEAR(std::atan2(tilt.sine_mode_4, shape.mode_4) / 4, angle, 1e-5);
    EXPECT_NEAR(tilt.sine_mode_3, 0, 1e-9);
    const double c = std::cos(angle), s = std::sin(angle);
    EXPECT_NEAR(tilt.flank_slope, (a * a - b * b) * s * c / (a * a * c * c + b * b * s * s), 1e-6);
  }
}

TEST(OutlineTilt, AnOutlineThatIsMirroredAtTheFlowHasTheOtherSign) {
  const OutlineTilt up = tilt_of(outline(0.1, 0.06, 0.2)), down = tilt_of(outline(0.1, 0.06, -0.2));
  EXPECT_GT(up.sine_mode_2, 0.02);
  EXPECT_GT(up.flank_slope, 0.05);
  for (const TiltFeature& feature : tilt_features()) EXPECT_NEAR(up.*feature.value, -(down.*feature.value), 1e-9);
  const OutlineTilt straight = tilt_of(outline(0.1, 0.06, 0));
  for (const TiltFeature& feature : tilt_features()) EXPECT_NEAR(straight.*feature.value, 0, 1e-9) << feature.name;
}

TEST(OutlineTilt, ACellThatMovesTheOtherWayHasTheSameTilt) {
  // The same cell seen in a recording whose cells move along -x.
  const OutlineTilt there = tilt_of(outline(0.1, 0.06, 0.2)), back = tilt_of(outline(0.1, 0.06, 0.2, -1), -1);
  for (const TiltFeature& feature : tilt_features()) EXPECT_NEAR(there.*feature.value, back.*feature.value, 1e-9);
}

TEST(OutlineTilt, ALineHasNone) {
  Polygon line;
  line.assign(std::vector<Eigen::Vector2d>{{1, 0}, {1, 1}, {1, 2}});
  EXPECT_TRUE(std::isnan(flank_slope(line, 1)));
}

}  // namespace
}  // namespace rheocyte::outline_tilt_test
