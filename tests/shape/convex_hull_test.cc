#include "shape/convex_hull.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "shape/measures.h"
#include "shapes.h"

namespace rheocyte::convex_hull_test {
namespace {

using std::numbers::pi;
using test::interpolate;

// Sums of some hundred terms of order one.
constexpr double rounding = 1e-13;
constexpr test::Resolution fine{.degree = 12, .pieces = 24};

struct Hull {
  double area, perimeter;
};

// Andrew's monotone chain over n points of the meridian and the feet of its extreme points on the axis: an
// independent, polygonal hull.
Hull polygon_hull(const test::Meridian& meridian, int n) {
  std::vector<std::pair<double, double>> points;
  for (int i = 0; i <= n; ++i) {
    const Eigen::Vector2d point = meridian(pi * i / n);
    points.emplace_back(point.x(), std::max(point.y(), 0.0));
  }
  std::sort(points.begin(), points.end());
  points.insert(points.begin(), {points.front().first, 0});
  points.emplace_back(points.back().first, 0);
  std::vector<Eigen::Vector2d> upper;
  for (const auto& [x, r] : points) {
    while (upper.size() > 1) {
      const Eigen::Vector2d first = upper.back() - upper[upper.size() - 2],
                            second = Eigen::Vector2d(x, r) - upper.back();
      if (first.x() * second.y() - first.y() * second.x() < 0) break;
      upper.pop_back();
    }
    upper.emplace_back(x, r);
  }
  Hull hull{0, 0};
  for (std::size_t i = 1; i < upper.size(); ++i) {
    hull.area += (upper[i].x() - upper[i - 1].x()) * (upper[i - 1].y() + upper[i].y());
    hull.perimeter += 2 * (upper[i] - upper[i - 1]).norm();
  }
  return hull;
}

void expect_hull_of(const test::Meridian& meridian, const ShapeMeasures& shape) {
  // 800,000 points of the closed curve: the polygon lacks (2/3) pi^2 / M^2 = 1e-11 of a circle's area, and some times
  // as much where the curvature is larger.
  const Hull hull = polygon_hull(meridian, 400000);
  EXPECT_NEAR(shape.area / hull.area, 1, 5e-11);
  EXPECT_NEAR(shape.perimeter / hull.perimeter, 1, 5e-11);
  EXPECT_GT(shape.area, shape.area_raw);
  EXPECT_LT(shape.perimeter, shape.perimeter_raw);
}

TEST(ConvexHull, AConvexContourIsItsOwnHull) {
  // Nothing is bridged, so both deformations are the same number.
  for (double a : {0.0, 1e-3, 0.05}) {
    const auto shape = measure(interpolate(test::polar([a](double t) { return 1 + a * std::cos(2 * t); }), fine));
    EXPECT_EQ(shape.deformation, shape.deformation_raw);
    EXPECT_EQ(shape.moment_ratio, shape.moment_ratio_raw);
  }
}

TEST(ConvexHull, ADentAtTheRearIsClosedByAChordAcrossTheAxis) {
  // x = c + k (1 - c)^2 with c = cos t, r = sin t: x' = 0 at c* = 1 - 1/(2k), and the chord hides
  // 2 int (x - x*) dr = 2 k int (c - c*)^2 c dt over the rear of the rim, an elementary integral.
  constexpr double k = 0.3, rim = 1 - 1 / (2 * k);
  const test::Meridian dented = [](double t) {
    const double c = std::cos(t);
    return Eigen::Vector2d(c + k * (1 - c) * (1 - c), std::sin(t));
  };
  const auto primitive = [](double t) {
    const double s = std::sin(t), c3 = s - s * s * s / 3, c2 = 0.5 * (t + s * std::cos(t));
    return c3 - 2 * rim * c2 + rim * rim * s;
  };
  const double hidden = -2 * k * (primitive(pi) - primitive(std::acos(rim)));
  const ShapeMeasures shape = measure(interpolate(dented, fine));
  EXPECT_NEAR(shape.area - shape.area_raw, hidden, rounding);
  expect_hull_of(dented, shape);
}

TEST(ConvexHull, AFlattenedRearWithoutADentStaysAsItIs) {
  // k = 0.2 in the curve above: flattened, but x' has no zero before the pole.
  const auto shape = measure(interpolate(
      [](double t) { return Eigen::Vector2d(std::cos(t) + 0.2 * std::pow(1 - std::cos(t), 2), std::sin(t)); }, fine));
  EXPECT_EQ(shape.area, shape.area_raw);
  EXPECT_EQ(shape.deformation, shape.deformation_raw);
}

TEST(ConvexHull, AConcaveFlankIsBridgedBetweenTwoTangencyPoints) {
  // r = 1 + a cos 2t is concave at the equator for a > 1/5; the chord is the horizontal common tangent, where
  // r sin t is greatest: with s = sin t, (1 + a) s - 2 a s^3 has its maximum at s*^2 = (1 + a)/(6 a).
  const double a = 0.4;
  const ShapeMeasures shape =
      measure(interpolate(test::polar([a](double t) { return 1 + a * std::cos(2 * t); }), fine));
  const double s = std::sqrt((1 + a) / (6 * a)), height = s * (1 + a - 2 * a * s * s), t0 = std::asin(s);
  const double half_width = (1 + a * std::cos(2 * t0)) * std::cos(t0);
  // Chord's triangle from the origin minus the sector of the curve, both halves, left and right.
  const auto sector = [a](double t) {
    return 0.5 * ((1 + 0.5 * a * a) * t + a * std::sin(2 * t) + a * a / 8 * std::sin(4 * t));
  };
  const double hidden = 4 * (0.5 * height * half_width - (sector(pi / 2) - sector(t0)));
  EXPECT_NEAR(shape.area - shape.area_raw, hidden, rounding);
  // The ends themselves, which area and perimeter do not feel to first order.
  const auto meridian =
      SampledMeridian::of(interpolate(test::polar([a](double t) { return 1 + a * std::cos(2 * t); }), fine));
  ASSERT_TRUE(meridian);
  const auto hull = convex_hull(*meridian, HullParts::all);
  ASSERT_TRUE(hull);
  const auto is_chord = [](const CurveArc& arc) { return arc.piece.rows() == 2; };
  const auto bridge = std::find_if(hull->arcs.begin(), hull->arcs.end(), is_chord);
  ASSERT_NE(bridge, hull->arcs.end());
  EXPECT_NEAR(bridge->piece(0, 0), half_width, rounding);
  EXPECT_NEAR(bridge->piece(1, 0), -half_width, rounding);
  expect_hull_of(test::polar([a](double t) { return 1 + a * std::cos(2 * t); }), shape);
}

TEST(ConvexHull, ObliqueBridgesAndDentsTogetherAgreeWithAFinePolygon) {
  // Wavy, cardioid and doubly dented curves against an independent polygonal hull.
  expect_hull_of(test::polar([](double t) { return 1 + 0.15 * std::cos(5 * t); }),
                 measure(interpolate(test::polar([](double t) { return 1 + 0.15 * std::cos(5 * t); }), fine)));
  const auto dented = test::polar([](double t) { return 1 + 0.9 * std::cos(t); });
  expect_hull_of(dented, measure(interpolate(dented, fine)));
  const auto both = test::polar([](double t) { return 1 - 0.4 * std::cos(2 * t) + 0.06 * std::cos(7 * t); });
  expect_hull_of(both, measure(interpolate(both, fine)));
}

TEST(ConvexHull, ACurveThatTurnsBackUnderItselfHasTheSameHull) {
  // A rear pocket with an overhang is still a simple curve; its hull is the square.
  const auto pocket = test::polygon({{2, 0}, {2, 1}, {0, 1}, {0, 0.5}, {0.5, 0.8}, {1, 0.8}, {1, 0}});
  const ShapeMeasures shape = measure(pocket);
  EXPECT_NEAR(shape.area, 4, rounding);
  EXPECT_NEAR(shape.perimeter, 8, rounding);
  EXPECT_NEAR(shape.moment_ratio, 1, rounding);
}

TEST(ConvexHull, APolygonsNotchIsBridgedFromCornerToCorner) {
  // The hull's tangency points may be corners where pieces join; area and perimeter are those of the hexagon.
  const auto notched = test::polygon({{2, 0}, {1, 1}, {0, 0.25}, {-1, 1}, {-2, 0}});
  const ShapeMeasures shape = measure(notched);
  EXPECT_NEAR(shape.area, 6, rounding);
  EXPECT_NEAR(shape.perimeter, 4 + 4 * std::sqrt(2.0), rounding);
  EXPECT_NEAR(shape.area_raw, 4.5, rounding);
}

}  // namespace
}  // namespace rheocyte::convex_hull_test
