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

/// Points along a hull, those of Gauss' rule on each part of it: cosines of their directions, and their weights in
/// int r d(theta).
struct Directions {
  std::vector<Eigen::Array4d> cosine, weight;
};

/// Adds the part from s0 to s1 of a straight line; s counts along it from the foot of the normal from the origin.
/// r d(theta) is distance ds / r there.
void add_part(const Point& foot, const Point& along, double s0, double s1, Directions& directions) {
  const Eigen::Array4d place{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526},
      weight{0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  const double middle = (s0 + s1) / 2, half = (s1 - s0) / 2;
  const Eigen::Array4d s = middle + half * place, per_radius = (foot.squaredNorm() + s.square()).sqrt().inverse();
  directions.cosine.emplace_back((foot.x() + s * along.x()) * per_radius);
  directions.weight.emplace_back(half * foot.norm() * weight * per_radius);
}

/// Adds one edge of a hull around the origin, in parts that are seen under small angles.
void add_edge(const Point& a, const Point& b, Directions& directions) {
  constexpr double widest = 0.2;  // radians; Gauss' error is then below 1e-9
  const Point along = (b - a).normalized(), foot = a - along * a.dot(along);
  const double s0 = a.dot(along), s1 = b.dot(along), distance = foot.norm();
  if (s1 - s0 < widest * distance) return add_part(foot, along, s0, s1, directions);
  const double first = std::atan2(s0, distance), angle = std::atan2(s1, distance) - first;
  const int parts = 1 + int(angle / widest);
  double start = s0;
  for (int part = 1; part <= parts; ++part) {
    const double end = part == parts ? s1 : distance * std::tan(first + angle * part / parts);
    add_part(foot, along, start, end, directions);
    start = end;
  }
}

/// int r cos(k theta) d(theta), k = 0 .. max_mode, once around.
std::array<double, max_mode + 1> radius_integrals(const std::vector<Point>& hull, const Point& centre) {
  Directions directions;
  directions.cosine.reserve(2 * hull.size());
  directions.weight.reserve(2 * hull.size());
  for (std::size_t i = 0; i < hull.size(); ++i)
    add_edge(hull[i] - centre, hull[(i + 1) % hull.size()] - centre, directions);
  const auto count = 4 * Eigen::Index(directions.cosine.size());
  const Eigen::Map<const Eigen::ArrayXd> cosine(directions.cosine.front().data(), count);
  const Eigen::Map<const Eigen::ArrayXd> weight(directions.weight.front().data(), count);
  Eigen::ArrayXd before = cosine, here = Eigen::ArrayXd::Ones(count);  // cos(-theta), cos(0)
  std::array<double, max_mode + 1> integral{};
  for (double& sum : integral) {
    sum = (weight * here).sum();
    before = 2 * cosine * here - before;
    before.swap(here);
  }
  return integral;
}

}  // namespace

OutlineShape hull_shape(const std::vector<Eigen::Vector2d>& hull) {
  if (hull.size() < 3) {
    OutlineShape none{no_value, no_value, no_value, no_value, no_value, no_value, {}};
    none.modes.fill(no_value);
    return none;
  }
  const Moments m = moments_of(hull);
  OutlineShape shape{m.area, 1 - 2 * std::sqrt(std::numbers::pi * m.area) / m.perimeter, m.yy / m.xx, m.centroid.x(),
                     m.centroid.y()};
  const auto integral = radius_integrals(hull, m.centroid);
  shape.mean_radius = integral[0] / (2 * std::numbers::pi);
  for (int k = min_mode; k <= max_mode; ++k)
    shape.modes[std::size_t(k - min_mode)] = 2 * integral[std::size_t(k)] / integral[0];
  return shape;
}

OutlineShape outline_shape(const Eigen::MatrixX2d& polygon) { return hull_shape(hull_of(polygon)); }

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
