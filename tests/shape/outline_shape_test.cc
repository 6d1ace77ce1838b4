#include "shape/outline_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rheocyte::outline_shape_test {
namespace {

constexpr double pi = std::numbers::pi;

Eigen::MatrixX2d ellipse(double a, double b, int points) {
  Eigen::MatrixX2d polygon(points, 2);
  for (int i = 0; i < points; ++i)
    polygon.row(i) << 3 + a * std::cos(2 * pi * i / points), -1 + b * std::sin(2 * pi * i / points);
  return polygon;
}

TEST(OutlineShape, AnEllipseHasItsExactMeasures) {
  // Area pi a b, moments a^3 b and a b^3, no odd modes; 4000 points leave 1e-6 to the polygon.
  const auto shape = outline_shape(ellipse(2, 1.5, 4000));
  EXPECT_NEAR(shape.area, pi * 3, 1e-5);
  EXPECT_NEAR(shape.moment_ratio, 2.25 / 4, 1e-6);
  EXPECT_NEAR(shape.x, 3, 1e-9);
  EXPECT_NEAR(shape.y, -1, 1e-9);
  EXPECT_NEAR(shape.modes[1], 0, 1e-9);
  EXPECT_GT(shape.modes[0], 0.1);
}

TEST(OutlineShape, ModesThatAreDrawnAreModesThatAreMeasured) {
  // The outline of some modes has the same modes again, but for its centroid, which the third mode moves by second
  // order: c2 c3 = 6e-4 at most.
  std::array<double, mode_count> modes{};
  modes[0] = 0.06, modes[1] = -0.01, modes[2] = 0.005;
  const auto shape = outline_shape(outline_of_modes(modes, 100, 2000));
  EXPECT_NEAR(shape.area, 100, 1e-3);
  for (int k = 0; k < mode_count; ++k) EXPECT_NEAR(shape.modes[std::size_t(k)], modes[std::size_t(k)], 1e-3) << k;
  // The other way round the front is the rear: odd modes change sign, even ones stay.
  Eigen::MatrixX2d turned = outline_of_modes(modes, 100, 2000);
  turned.col(0) *= -1;
  const auto back = outline_shape(turned);
  for (int k = 0; k < mode_count; ++k)
    EXPECT_NEAR(back.modes[std::size_t(k)], (k % 2 ? -1 : 1) * shape.modes[std::size_t(k)], 1e-9) << k;
}

TEST(OutlineShape, ADentIsNotSeen) {
  // A square with a notch is a square to the camera: d = 1 - sqrt(pi) / 2 and c4 as that of its four corners.
  Eigen::MatrixX2d square(4, 2), notched(5, 2);
  square << 0, 0, 2, 0, 2, 2, 0, 2;
  notched << 0, 0, 2, 0, 2, 2, 0, 2, 0.5, 1;
  const auto whole = outline_shape(square), dented = outline_shape(notched);
  EXPECT_NEAR(whole.deformation, 1 - std::sqrt(pi) / 2, 1e-12);
  EXPECT_NEAR(shape_vector(whole)(0), std::log(4.0), 1e-12);
  EXPECT_EQ(shape_vector(dented), shape_vector(whole));
  EXPECT_NEAR(whole.modes[2], 2 * (1 - 2 * std::sqrt(2) / (3 * std::asinh(1))), 1e-14);
}

TEST(OutlineShape, TheModesOfATriangleAreIntegralsOfItsRadius) {
  // r = d / cos(theta - phi) on an edge whose normal has the length d and the direction phi, summed by Simpson's rule.
  Eigen::MatrixX2d triangle(3, 2);
  triangle << -1, -1, 2, 0.3, 0.5, 1.5;
  const Eigen::RowVector2d centroid = triangle.colwise().mean();
  std::array<double, max_mode + 1> integral{};
  for (int edge = 0; edge < 3; ++edge) {
    const Eigen::RowVector2d a = triangle.row(edge) - centroid, b = triangle.row((edge + 1) % 3) - centroid;
    const double phi = std::atan2(a.x() - b.x(), b.y() - a.y()), first = std::atan2(a.y(), a.x());
    const double distance = a.x() * std::cos(phi) + a.y() * std::sin(phi);
    const double angle = std::remainder(std::atan2(b.y(), b.x()) - first, 2 * pi);
    constexpr int intervals = 4000;
    for (int i = 0; i <= intervals; ++i) {
      const double theta = first + angle * i / intervals, r = distance / std::cos(theta - phi);
      const double weight = (i == 0 || i == intervals ? 1 : 2 + 2 * (i % 2)) * angle / (3 * intervals);
      for (int k = 0; k <= max_mode; ++k) integral[std::size_t(k)] += weight * r * std::cos(k * theta);
    }
  }
  const auto shape = outline_shape(triangle);
  EXPECT_NEAR(shape.mean_radius, integral[0] / (2 * pi), 1e-11);
  for (int k = min_mode; k <= max_mode; ++k)
    EXPECT_NEAR(shape.modes[std::size_t(k - min_mode)], 2 * integral[std::size_t(k)] / integral[0], 1e-11) << k;
}

TEST(OutlineShape, PartsOfAShapeAreThoseOfTheWhole) {
  Polygon hull, line;
  hull.assign(std::vector<Eigen::Vector2d>{{-1, -1}, {2, 0.3}, {1.7, 0.9}, {0.5, 1.5}});
  line.assign(std::vector<Eigen::Vector2d>{{0, 0}, {1, 1}});
  const OutlineShape whole = hull_shape(hull);
  const RadiusModes modes = hull_modes(hull);
  const HullAsymmetry asymmetry = hull_asymmetry(hull);
  for (std::size_t i = 0; i < modes.size(); ++i) EXPECT_EQ(modes[i], whole.modes[i]) << i;
  EXPECT_EQ(asymmetry.moment_ratio, whole.moment_ratio);
  EXPECT_EQ(asymmetry.mode_2, whole.modes[0]);
  EXPECT_EQ(asymmetry.mode_3, whole.modes[1]);
  EXPECT_TRUE(std::isnan(hull_asymmetry(line).mode_3));
}

TEST(OutlineShape, PointsOnALineHaveNoShape) {
  // NaN, not a crash: masks of one row of pixels occur.
  Eigen::MatrixX2d line(4, 2);
  line << 0, 1, 2, 1, 5, 1, 3, 1;
  EXPECT_TRUE(shape_vector(outline_shape(line)).array().isNaN().all());
  EXPECT_TRUE(shape_vector(outline_shape(line.topRows(1))).array().isNaN().all());
}

TEST(OutlineShape, AMeridianClosesWithItsMirrorImage) {
  // Half a circle gives a circle.
  Eigen::MatrixX2d meridian(201, 2);
  for (int i = 0; i <= 200; ++i) meridian.row(i) << std::cos(pi * i / 200), std::sin(pi * i / 200);
  const auto shape = outline_shape(mirrored(meridian));
  EXPECT_NEAR(shape.area, pi, 1e-3);
  EXPECT_NEAR(shape.moment_ratio, 1, 1e-9);
  for (const double mode : shape.modes) EXPECT_NEAR(mode, 0, 1e-9);
}

}  // namespace
}  // namespace rheocyte::outline_shape_test
