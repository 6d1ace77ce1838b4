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

using Lanes = Eigen::Array<double, Polygon::block, 1>;

/// Edges of a hull as they are seen from its centre: the ends at the place `along` from the foot of the perpendicular,
/// whose length is `distance` and whose direction is (normal_x, normal_y).
struct Edges {
  Lanes distance, normal_x, normal_y, along_start, along_end;
};

/// Edges without length have the distance 1 and no `weight`. The centre counts from the polygon's origin.
Edges edges_from(const Polygon& polygon, std::size_t first, const Point& centre, Lanes& weight) {
  const auto block = [first](const double* values, double middle) {
    return Lanes(Eigen::Map<const Lanes>(values + first) - middle);
  };
  const Lanes ax = block(polygon.x(), centre.x()), ay = block(polygon.y(), centre.y()),
              bx = block(polygon.x() + 1, centre.x()), by = block(polygon.y() + 1, centre.y());
  const Lanes length = ((bx - ax).square() + (by - ay).square()).sqrt();
  const Lanes divisor = (length > 0).select(length, 1), tx = (bx - ax) / divisor, ty = (by - ay) / divisor;
  weight = ax * ty - ay * tx;
  return {(length > 0).select(weight, 1), ty, -tx, ax * tx + ay * ty, bx * tx + by * ty};
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

/// int r cos(k theta) d(theta) and int r sin(k theta) d(theta), k = 0 .. last.
template <class Number, int last>
struct Harmonics {
  std::array<Number, last + 1> cosine, sine;

  double c(int k) const { return 2 * cosine[std::size_t(k)] / cosine[0]; }
  double s(int k) const { return 2 * sine[std::size_t(k)] / cosine[0]; }
};

/// Adds those of some edges. Exact: with phi counted from the normal of an edge, r = d / cos(phi) and theta = phi +
/// beta, where C_k + i S_k = int exp(i k phi) / cos(phi) d(phi) obeys
/// C_k + C_{k-2} + i (S_k + S_{k-2}) = 2 [exp(i (k-1) phi)] / (i (k-1)): the sum has no denominator any more.
template <int last>
void add_radius_integrals(const Edges& e, const Lanes& weight, Harmonics<Lanes, last>& integral) {
  const Lanes start_radius = (e.distance.square() + e.along_start.square()).sqrt();
  const Lanes end_radius = (e.distance.square() + e.along_end.square()).sqrt();
  const auto sum_of = [&](const Lanes& along, const Lanes& radius) {  // along + radius without cancellation
    const Lanes large = along.abs() + radius;
    return Lanes((along < 0).select(e.distance.square() / large, large));
  };
  Lanes turn;
  for (int i = 0; i < int(Polygon::block); ++i)
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
  for (std::size_t k = 0; k <= last; ++k) {
    integral.cosine[k] += weight * (normal_cos.here * c - normal_sin.here * s);
    integral.sine[k] += weight * (normal_sin.here * c + normal_cos.here * s);
    const Lanes after_c = 2.0 / double(k + 1) * (end_sin.here - start_sin.here) - c;
    const Lanes after_s = -2.0 / double(k + 1) * (end_cos.here - start_cos.here) - s;
    c = next_c, s = next_s, next_c = after_c, next_s = after_s;
    for (Multiples* start : {&start_cos, &start_sin}) start->advance(twice_start);
    for (Multiples* end : {&end_cos, &end_sin}) end->advance(twice_end);
    for (Multiples* normal : {&normal_cos, &normal_sin}) normal->advance(twice_normal);
  }
}

/// Once around a hull that runs counterclockwise about its centroid.
template <int last>
Harmonics<double, last> radius_integrals(const Polygon& hull, const PolygonMoments& moments) {
  const Point centre = Point(moments.x, moments.y) - hull.origin();
  Harmonics<Lanes, last> sums;
  sums.cosine.fill(Lanes::Zero());
  sums.sine.fill(Lanes::Zero());
  Lanes weight;
  for (std::size_t first = 0; first < hull.edges(); first += Polygon::block) {
    const Edges edges = edges_from(hull, first, centre, weight);
    add_radius_integrals(edges, weight, sums);
  }
  Harmonics<double, last> integral;
  const auto add_up = [](const Lanes& sum) { return sum.sum(); };
  std::ranges::transform(sums.cosine, integral.cosine.begin(), add_up);
  std::ranges::transform(sums.sine, integral.sine.begin(), add_up);
  return integral;
}

OutlineShape figure_of(const PolygonMoments& m) {
  return {m.area, 1 - 2 * std::sqrt(std::numbers::pi * m.area) / m.perimeter, m.mu02 / m.mu20, m.x, m.y};
}

Polygon polygon_of_hull(const Eigen::MatrixX2d& polygon) {
  Polygon hull;
  hull.assign(hull_of(polygon));
  return hull;
}

}  // namespace

OutlineShape hull_figure(const Polygon& hull) {
  if (hull.corners() < 3) return {no_value, no_value, no_value, no_value, no_value};
  return figure_of(hull.moments());
}

OutlineShape outline_figure(const Eigen::MatrixX2d& polygon) { return hull_figure(polygon_of_hull(polygon)); }

OutlineShape hull_shape(const Polygon& hull) {
  if (hull.corners() < 3) {
    OutlineShape none{no_value, no_value, no_value, no_value, no_value, no_value, {}};
    none.modes.fill(no_value);
    return none;
  }
  const PolygonMoments m = hull.moments();
  OutlineShape shape = figure_of(m);
  const auto integral = radius_integrals<max_mode>(hull, m);
  shape.mean_radius = integral.cosine[0] / (2 * std::numbers::pi);
  for (int k = min_mode; k <= max_mode; ++k) shape.modes[std::size_t(k - min_mode)] = integral.c(k);
  return shape;
}

RadiusModes hull_modes(const Polygon& hull) {
  RadiusModes modes;
  modes.fill(no_value);
  if (hull.corners() < 3) return modes;
  const auto integral = radius_integrals<last_radius_mode>(hull, hull.moments());
  for (int k = first_radius_mode; k <= last_radius_mode; ++k) modes[std::size_t(k - first_radius_mode)] = integral.c(k);
  return modes;
}

HullAsymmetry hull_asymmetry(const Polygon& hull) {
  if (hull.corners() < 3) return {};
  const PolygonMoments m = hull.moments();
  const auto integral = radius_integrals<5>(hull, m);
  return {m.mu02 / m.mu20, integral.c(2), integral.c(3),
          integral.c(4),   integral.c(5), {integral.s(2), integral.s(3), integral.s(4)}};
}

OutlineShape outline_shape(const Eigen::MatrixX2d& polygon) { return hull_shape(polygon_of_hull(polygon)); }

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
    const double theta = 2 * std::numbers::pi * i / points, cosine = std::cos(theta);
    double sum = 0, before = 0;  // Clenshaw: cos(k theta) are the Chebyshev polynomials of cos(theta)
    for (int k = max_mode; k > 0; --k)
      before = std::exchange(sum, (k < min_mode ? 0 : modes[std::size_t(k - min_mode)]) + 2 * cosine * sum - before);
    const double r = mean * (1 + cosine * sum - before);
    outline.row(i) << r * cosine, r * std::sin(theta);
  }
  return outline;
}

Eigen::MatrixX2d outline_of_hull_modes(const std::array<double, mode_count>& modes, double area, int points) {
  constexpr int rounds = 6;
  std::array<double, mode_count> tried = modes;
  double size = area;
  for (int round = 0; round < rounds; ++round) {
    const OutlineShape hull = outline_shape(outline_of_modes(tried, size, points));
    for (std::size_t k = 0; k < tried.size(); ++k) tried[k] += modes[k] - hull.modes[k];
    size *= area / hull.area;
  }
  return outline_of_modes(tried, size, points);
}

double volume_of_revolution(const Eigen::MatrixX2d& outline) {
  assert(outline.rows() % 2 == 0);
  double sum = 0;  // of frusta
  for (Eigen::Index i = 0; i < outline.rows() / 2; ++i) {
    const double a = outline(i, 1), b = outline(i + 1, 1);
    sum += (outline(i, 0) - outline(i + 1, 0)) * (a * a + a * b + b * b);
  }
  return std::numbers::pi / 3 * sum;
}

}  // namespace rheocyte
