#include "shape/outline_shape.h"

#include <algorithm>
#include <cassert>
#include <cmath>
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
  const Point& origin = hull.front();  // near the cell: no cancellation
  Point a = hull.back() - origin;
  for (const Point& corner : hull) {
    const Point b = corner - origin;
    const double w = cross(a, b);
    m.area += w / 2;
    m.centroid += w * (a + b) / 6;
    m.xx += w * (a.x() * a.x() + a.x() * b.x() + b.x() * b.x()) / 12;
    m.yy += w * (a.y() * a.y() + a.y() * b.y() + b.y() * b.y()) / 12;
    m.perimeter += (b - a).norm();
    a = b;
  }
  m.centroid /= m.area;
  m.xx -= m.area * m.centroid.x() * m.centroid.x();
  m.yy -= m.area * m.centroid.y() * m.centroid.y();
  m.centroid += origin;
  return m;
}

/// Some edges at once, so that the processor computes them side by side.
constexpr int lanes = 8;
using Lanes = Eigen::Array<double, lanes, 1>;

/// Edges of a hull as they are seen from its centre: the ends at the place `along` from the foot of the perpendicular,
/// whose length is `distance` and whose direction is (normal_x, normal_y).
struct Edges {
  Lanes distance, normal_x, normal_y, along_start, along_end;
};

/// Of fewer edges than there are lanes the others have the length 1 and no `weight`.
Edges edges_from(const std::vector<Point>& hull, std::size_t first, const Point& centre, Lanes& weight) {
  Lanes ax = Lanes::Ones(), ay = Lanes::Zero(), bx = Lanes::Ones(), by = Lanes::Ones();
  const std::size_t count = std::min<std::size_t>(lanes, hull.size() - first);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = first + i + 1 < hull.size() ? first + i + 1 : 0;
    const auto lane = Eigen::Index(i);
    ax(lane) = hull[first + i].x() - centre.x();
    ay(lane) = hull[first + i].y() - centre.y();
    bx(lane) = hull[next].x() - centre.x();
    by(lane) = hull[next].y() - centre.y();
  }
  const Lanes length = ((bx - ax).square() + (by - ay).square()).sqrt(), tx = (bx - ax) / length,
              ty = (by - ay) / length;
  const Lanes distance = ax * ty - ay * tx;
  weight = distance;
  weight.tail(lanes - Eigen::Index(count)) = 0;
  return {distance, ty, -tx, ax * tx + ay * ty, bx * tx + by * ty};
}

/// cos(k angle) or sin(k angle), k = 0, 1, ..., from the one before.
struct Multiples {
  Lanes before, here;
  void advance(const Lanes& twice_cosine) {
    const Lanes next = twice_cosine * here - before;
    before = here;
    here = next;
  }
};

/// Adds int r cos(k theta) d(theta) over some edges, k = 0, 1, ... Exact: with phi counted from the normal of an
/// edge, r = d / cos(phi) and theta = phi + beta, where C_k + i S_k = int exp(i k phi) / cos(phi) d(phi) obeys
/// C_k + C_{k-2} + i (S_k + S_{k-2}) = 2 [exp(i (k-1) phi)] / (i (k-1)): the sum has no denominator any more.
template <std::size_t count>
void add_radius_integrals(const Edges& e, const Lanes& weight, std::array<Lanes, count>& integral) {
  const Lanes start_radius = (e.distance.square() + e.along_start.square()).sqrt();
  const Lanes end_radius = (e.distance.square() + e.along_end.square()).sqrt();
  const auto sum_of = [&](const Lanes& along, const Lanes& radius) {  // along + radius without cancellation
    const Lanes large = along.abs() + radius;
    return Lanes((along < 0).select(e.distance.square() / large, large));
  };
  Lanes turn;
  for (int i = 0; i < lanes; ++i)
    turn(i) = std::atan2((e.along_end(i) - e.along_start(i)) * e.distance(i),
                         e.distance(i) * e.distance(i) + e.along_start(i) * e.along_end(i));
  // C and S of k and of k + 1
  Lanes c = (sum_of(e.along_end, end_radius) / sum_of(e.along_start, start_radius)).log(), s = Lanes::Zero();
  Lanes next_c = turn, next_s = (end_radius / start_radius).log();
  const Lanes start_cosine = e.distance / start_radius, end_cosine = e.distance / end_radius;
  const Lanes twice_start = 2 * start_cosine, twice_end = 2 * end_cosine, twice_normal = 2 * e.normal_x;
  Multiples start_cos{Lanes::Ones(), start_cosine}, start_sin{Lanes::Zero(), e.along_start / start_radius};
  Multiples end_cos{Lanes::Ones(), end_cosine}, end_sin{Lanes::Zero(), e.along_end / end_radius};
  Multiples normal_cos{e.normal_x, Lanes::Ones()}, normal_sin{-e.normal_y, Lanes::Zero()};  // of -beta, then of 0
  for (std::size_t k = 0; k < count; ++k) {
    integral[k] += weight * (normal_cos.here * c - normal_sin.here * s);
    const Lanes after_c = 2.0 / double(k + 1) * (end_sin.here - start_sin.here) - c;
    const Lanes after_s = -2.0 / double(k + 1) * (end_cos.here - start_cos.here) - s;
    c = next_c, s = next_s, next_c = after_c, next_s = after_s;
    for (Multiples* start : {&start_cos, &start_sin}) start->advance(twice_start);
    for (Multiples* end : {&end_cos, &end_sin}) end->advance(twice_end);
    for (Multiples* normal : {&normal_cos, &normal_sin}) normal->advance(twice_normal);
  }
}

/// Of k = 0 .. last, once around a hull that runs counterclockwise around `centre`.
template <int last>
std::array<double, last + 1> radius_integrals(const std::vector<Point>& hull, const Point& centre) {
  std::array<Lanes, last + 1> sums;
  sums.fill(Lanes::Zero());
  Lanes weight;
  for (std::size_t first = 0; first < hull.size(); first += lanes) {
    const Edges edges = edges_from(hull, first, centre, weight);
    add_radius_integrals(edges, weight, sums);
  }
  std::array<double, last + 1> integral;
  std::ranges::transform(sums, integral.begin(), [](const Lanes& sum) { return sum.sum(); });
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
  const auto integral = radius_integrals<max_mode>(hull, m.centroid);
  shape.mean_radius = integral[0] / (2 * std::numbers::pi);
  for (int k = min_mode; k <= max_mode; ++k)
    shape.modes[std::size_t(k - min_mode)] = 2 * integral[std::size_t(k)] / integral[0];
  return shape;
}

RadiusModes hull_modes(const std::vector<Eigen::Vector2d>& hull) {
  RadiusModes modes;
  modes.fill(no_value);
  if (hull.size() < 3) return modes;
  const auto integral = radius_integrals<last_radius_mode>(hull, moments_of(hull).centroid);
  for (int k = first_radius_mode; k <= last_radius_mode; ++k)
    modes[std::size_t(k - first_radius_mode)] = 2 * integral[std::size_t(k)] / integral[0];
  return modes;
}

HullAsymmetry hull_asymmetry(const std::vector<Eigen::Vector2d>& hull) {
  if (hull.size() < 3) return {no_value, no_value, no_value};
  const Moments m = moments_of(hull);
  const auto integral = radius_integrals<3>(hull, m.centroid);
  return {m.yy / m.xx, 2 * integral[2] / integral[0], 2 * integral[3] / integral[0]};
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
