#include "shape/outline_shape.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "numeric/no_value.h"
#include "shape/cross.h"

namespace rheocyte {

namespace {

using Point = Eigen::Vector2d;

/// Counterclockwise, without points on its edges (monotone chain).
std::vector<Point> hull_of(const Eigen::MatrixX2d& polygon) {
  assert(polygon.rows() > 0);
  std::vector<Point> points;
  for (Eigen::Index i = 0; i < polygon.rows(); ++i) points.emplace_back(polygon.row(i).transpose());
  std::ranges::sort(points,
                    [](const Point& a, const Point& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  std::vector<Point> hull;
  const auto add = [&](const Point& p, std::size_t first) {
    while (hull.size() >= first + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
      hull.pop_back();
    hull.push_back(p);
  };
  for (const auto& p : points) add(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
  hull.pop_back();
  return hull;
}

/// Area, centroid and moments of a polygon (docs/theory.md, eq:shape).
struct Moments {
  double area = 0, xx = 0, yy = 0, perimeter = 0;
  Point centroid = Point::Zero();
};

Moments moments_of(const std::vector<Point>& hull) {
  Moments m;
  const Point origin = hull.front();  // near the cell: no cancellation
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point a = hull[i] - origin, b = hull[(i + 1) % hull.size()] - origin;
    const double w = cross(a, b);
    m.area += w / 2;
    m.centroid += w * (a + b) / 6;
    m.xx += w * (a.x() * a.x() + a.x() * b.x() + b.x() * b.x()) / 12;
    m.yy += w * (a.y() * a.y() + a.y() * b.y() + b.y() * b.y()) / 12;
    m.perimeter += (b - a).norm();
  }
  m.centroid /= m.area;
  m.xx -= m.area * m.centroid.x() * m.centroid.x();
  m.yy -= m.area * m.centroid.y() * m.centroid.y();
  m.centroid += origin;
  return m;
}

/// Adds the integrals of r cos(k theta), k = 0 .. max_mode, along one edge, seen from the origin: the radius of a
/// straight line is distance / cos(theta - direction of its normal).
void add_edge(const Point& a, const Point& b, std::array<double, max_mode + 1>& integral) {
  static constexpr std::array<double, 4> place{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                               0.8611363115940526},
      weight{0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  constexpr double widest = 0.2;  // radians; Gauss' error is then below 1e-9
  const double start = std::atan2(a.y(), a.x()), angle = std::atan2(cross(a, b), a.dot(b));
  const Point along = (b - a).normalized();
  const double distance = cross(a, along), normal = std::atan2(-along.x(), along.y());
  const int parts = 1 + int(std::abs(angle) / widest);
  for (int part = 0; part < parts; ++part)
    for (std::size_t q = 0; q < place.size(); ++q) {
      const double theta = start + angle * (part + 0.5 + 0.5 * place[q]) / parts;
      const double r = distance / std::cos(theta - normal) * weight[q] * angle / (2 * parts), c = std::cos(theta);
      double before = c, here = 1;  // cos(-theta), cos(0)
      for (double& sum : integral) {
        sum += r * here;
        before = std::exchange(here, 2 * c * here - before);
      }
    }
}

}  // namespace

OutlineShape outline_shape(const Eigen::MatrixX2d& polygon) {
  const auto hull = hull_of(polygon);
  if (hull.size() < 3) {
    OutlineShape none{no_value, no_value, no_value, no_value, no_value, no_value, {}};
    none.modes.fill(no_value);
    return none;
  }
  const Moments m = moments_of(hull);
  OutlineShape shape{m.area, 1 - 2 * std::sqrt(std::numbers::pi * m.area) / m.perimeter, m.yy / m.xx, m.centroid.x(),
                     m.centroid.y()};
  std::array<double, max_mode + 1> integral{};
  for (std::size_t i = 0; i < hull.size(); ++i)
    add_edge(hull[i] - m.centroid, hull[(i + 1) % hull.size()] - m.centroid, integral);
  shape.mean_radius = integral[0] / (2 * std::numbers::pi);
  for (int k = min_mode; k <= max_mode; ++k)
    shape.modes[std::size_t(k - min_mode)] = 2 * integral[std::size_t(k)] / integral[0];
  return shape;
}

ShapeVector shape_vector(const OutlineShape& shape) {
  ShapeVector vector;
  vector << std::log(shape.area), shape.deformation, shape.moment_ratio,
      Eigen::Map<const Eigen::Matrix<double, mode_count, 1>>(shape.modes.data());
  return vector;
}

Eigen::MatrixX2d mirrored(const Eigen::MatrixX2d& meridian) {
  const Eigen::Index n = meridian.rows();
  Eigen::MatrixX2d polygon(2 * n - 2, 2);
  polygon.topRows(n) = meridian;
  for (Eigen::Index i = 1; i < n - 1; ++i) polygon.row(n - 1 + i) << meridian(n - 1 - i, 0), -meridian(n - 1 - i, 1);
  return polygon;
}

Eigen::MatrixX2d outline_of_modes(const std::array<double, mode_count>& modes, double area, int points) {
  // The area of r(theta) is pi r0^2 (1 + sum c_k^2 / 2).
  double squares = 0;
  for (const double c : modes) squares += c * c;
  const double mean = std::sqrt(area / (std::numbers::pi * (1 + squares / 2)));
  Eigen::MatrixX2d outline(points, 2);
  for (int i = 0; i < points; ++i) {
    const double theta = 2 * std::numbers::pi * i / points;
    double r = 1;
    for (int k = min_mode; k <= max_mode; ++k) r += modes[std::size_t(k - min_mode)] * std::cos(k * theta);
    outline.row(i) << mean * r * std::cos(theta), mean * r * std::sin(theta);
  }
  return outline;
}

}  // namespace rheocyte
