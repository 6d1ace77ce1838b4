#include "shape/outline_shape.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>
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

/// int r cos(k theta) d(theta), k = 0 .. max_mode, once around a hull that runs counterclockwise around `centre`.
/// Exact: with v = r exp(i theta), n the unit normal of an edge at the distance d, and v = n (d + i s) on it,
/// F_k = int exp(i k theta) r / d d(theta) obeys F_k = n (2 [exp(i (k-1) theta)] / (i (k-1)) - n F_{k-2}) there,
/// because the sum of two such integrands, k and k-2, has no denominator any more.
std::array<double, max_mode + 1> radius_integrals(const std::vector<Point>& hull, const Point& centre) {
  const auto edges = Eigen::Index(hull.size());
  Eigen::ArrayXcd vertex(edges + 1);  // the first one closes the hull
  for (Eigen::Index i = 0; i <= edges; ++i) {
    const Point from_centre = hull[std::size_t(i % edges)] - centre;
    vertex(i) = {from_centre.x(), from_centre.y()};
  }
  const auto change = [edges](const auto& at_vertices) { return at_vertices.tail(edges) - at_vertices.head(edges); };
  constexpr std::complex<double> i{0, 1};
  const Eigen::ArrayXcd along = change(vertex) / change(vertex).abs2().sqrt(), normal = -i * along;
  const Eigen::ArrayXd distance = (vertex.head(edges) * normal.conjugate()).real(), radius = vertex.abs2().sqrt();
  const Eigen::ArrayXd log_radius = radius.log(), turn = (vertex.tail(edges) * vertex.head(edges).conjugate()).arg();
  const auto arsinh = [&](const auto& vertices) {  // of s / d
    const Eigen::ArrayXd t = (vertices * along.conjugate()).real() / distance;
    const Eigen::ArrayXd of_size = (t.abs() + (1 + t.square()).sqrt()).log();
    return Eigen::ArrayXd((t < 0).select(-of_size, of_size));
  };
  const Eigen::ArrayXcd direction = vertex / radius;
  Eigen::ArrayXcd before = arsinh(vertex.tail(edges)) - arsinh(vertex.head(edges));
  Eigen::ArrayXcd here = normal * (turn + i * change(log_radius)), power = direction;
  std::array<double, max_mode + 1> integral{};
  for (int k = 0; k <= max_mode; ++k) {
    integral[std::size_t(k)] = (distance * before.real()).sum();
    before = normal * (-2.0 * i / (k + 1.0) * change(power) - normal * before);
    before.swap(here);
    power *= direction;
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
