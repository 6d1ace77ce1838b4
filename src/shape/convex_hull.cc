#include "shape/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "numeric/roots.h"
#include "shape/curve.h"

namespace rheocyte {
namespace {

struct Interval {
  double lower, upper;
};

struct Bridge {
  double start, end;  // global parameters of the tangency points
  double depth;       // of the hollow below the chord
};

// Where a unimodal function is greatest: golden section, which never loses the maximum, but resolves no more than the
// root of rounding, and then the zero of the slope, if the bracket that is left has one.
template <class Function, class Slope>
double place_of_maximum(const Function& f, const Slope& slope, Interval interval) {
  constexpr double ratio = 0.6180339887498949;
  constexpr int steps = 20;  // 0.618^20 = 7e-5 of a sample distance
  auto [a, b] = interval;
  double c = b - ratio * (b - a), d = a + ratio * (b - a);
  double fc = f(c), fd = f(d);
  for (int i = 0; i < steps; ++i) {
    if (fc > fd) {
      b = std::exchange(d, c);
      fd = std::exchange(fc, f(c = b - ratio * (b - a)));
    } else {
      a = std::exchange(c, d);
      fc = std::exchange(fd, f(d = a + ratio * (b - a)));
    }
  }
  const double inside = slope(a) > 0 && slope(b) < 0 ? bracketed_root(slope, a, b) : 0.5 * (a + b);
  const double best_end = f(interval.lower) >= f(interval.upper) ? interval.lower : interval.upper;
  return f(best_end) >= f(inside) ? best_end : inside;
}

// The farthest point of the curve in a direction; a joint of pieces may be a corner, so each piece is searched alone.
double support(const SampledMeridian& meridian, const Eigen::Vector2d& direction, Interval window) {
  double best = window.lower;
  for (double lower = window.lower; lower < window.upper;) {
    const double first = std::floor(lower), upper = std::min(window.upper, first + 1);
    const CurvePiece& piece = meridian.pieces()[static_cast<std::size_t>(first)];
    const CurvePiece tangent = derivative(piece);
    const auto height = [&](double s) { return direction.dot(evaluate(piece, s - first)); };
    const auto slope = [&](double s) { return direction.dot(evaluate(tangent, s - first)); };
    const double place = place_of_maximum(height, slope, {lower, upper});
    if (height(place) > direction.dot(meridian.point(best))) best = place;
    lower = upper;
  }
  return best;
}

Interval around(const SampledMeridian& meridian, int sample, Interval allowed) {
  return {std::max(allowed.lower, SampledMeridian::parameter(std::max(sample - 1, 0))),
          std::min(allowed.upper, SampledMeridian::parameter(std::min(sample + 1, meridian.last_sample())))};
}

// Direction (dx, dr) of travel from front to rear over the top; the outside lies to the right of it.
Eigen::Vector2d outward_normal(const Eigen::Vector2d& direction) {
  return Eigen::Vector2d(direction.y(), -direction.x()).normalized();
}

bool turns_inward(const Eigen::MatrixX2d& points, int a, int b, int c) {
  const Eigen::Vector2d first = points.row(b) - points.row(a), second = points.row(c) - points.row(b);
  return first.x() * second.y() - first.y() * second.x() > 0;
}

// Monotone chain over the samples from `front` (largest x) to `rear` (smallest x).
std::vector<int> hull_samples(const Eigen::MatrixX2d& points, int front, int rear) {
  std::vector<int> order(std::max(rear - front + 1, 0));
  if (order.size() < 2) return {};
  std::iota(order.begin(), order.end(), front);
  std::sort(order.begin() + 1, order.end() - 1,
            [&](int i, int j) { return points(i, 0) != points(j, 0) ? points(i, 0) > points(j, 0) : i < j; });
  std::vector<int> hull;
  for (int next : order) {
    while (hull.size() > 1 && !turns_inward(points, hull[hull.size() - 2], hull.back(), next)) hull.pop_back();
    hull.push_back(next);
  }
  return hull;
}

// Each pass takes the chord's normal and moves both ends to the farthest points in that direction; this is Newton's
// method for the slope of the common tangent and converges quadratically.
std::optional<Bridge> refine(const SampledMeridian& meridian, int from, int to, Interval allowed) {
  constexpr int max_passes = 8;
  constexpr double resolved = 1e-9;
  Bridge bridge{std::max(SampledMeridian::parameter(from), allowed.lower),
                std::min(SampledMeridian::parameter(to), allowed.upper), 0};
  Eigen::Vector2d normal;
  for (int pass = 0; pass < max_passes; ++pass) {
    const Eigen::Vector2d chord = meridian.point(bridge.end) - meridian.point(bridge.start);
    if (!(chord.norm() > 0) || bridge.end <= bridge.start) return std::nullopt;
    normal = outward_normal(chord);
    const double start = support(meridian, normal, around(meridian, from, allowed));
    const double end = support(meridian, normal, around(meridian, to, allowed));
    const bool done = std::abs(start - bridge.start) + std::abs(end - bridge.end) < resolved;
    bridge.start = start;
    bridge.end = end;
    if (done) break;
  }
  if (bridge.end <= bridge.start) return std::nullopt;
  const double chord_height = normal.dot(meridian.point(bridge.start));
  for (int sample = from + 1; sample < to; ++sample)
    bridge.depth = std::max(bridge.depth, chord_height - meridian.points().row(sample).dot(normal));
  return bridge;
}

std::vector<Bridge> bridges_over(const SampledMeridian& meridian, const std::vector<int>& hull, Interval allowed) {
  std::vector<Bridge> bridges;
  for (std::size_t k = 1; k < hull.size(); ++k) {
    if (hull[k] - hull[k - 1] < 2) continue;
    const auto bridge = refine(meridian, hull[k - 1], hull[k], allowed);
    if (!bridge) continue;
    bridges.push_back(*bridge);
    allowed.lower = bridge->end;
  }
  return bridges;
}

CurveArc chord(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  CurvePiece piece(2, 2);
  piece << from.transpose(), to.transpose();
  return {piece, 0, 1};
}

void append_curve(ArcChain& arcs, const SampledMeridian& meridian, Interval interval) {
  const int pieces = static_cast<int>(meridian.pieces().size());
  for (int i = std::max(static_cast<int>(interval.lower), 0); i < pieces && i < interval.upper; ++i) {
    const double start = std::max(interval.lower - i, 0.0), end = std::min(interval.upper - i, 1.0);
    if (end > start) arcs.push_back({meridian.pieces()[i], start, end});
  }
}

// The farthest sample along the axis; of equal ones the one farthest from the axis, which bridges a flat end at once.
int extreme_sample(const Eigen::MatrixX2d& points, double sign) {
  int best = 0;
  for (int i = 1; i < points.rows(); ++i) {
    const double gain = sign * (points(i, 0) - points(best, 0));
    if (gain > 0 || (gain == 0 && points(i, 1) > points(best, 1))) best = i;
  }
  return best;
}

// Where the curve leaves the front plane and meets the rear plane that touch it: its poles, or the rims of the dents.
Interval between_dents(const SampledMeridian& meridian, int front, int rear) {
  const Interval all{0, meridian.last_parameter()};
  Interval rims{support(meridian, {1, 0}, around(meridian, front, all)),
                support(meridian, {-1, 0}, around(meridian, rear, all))};
  // A dent as shallow as rounding is none.
  const double min_depth = 1e-14 * meridian.size();
  if (meridian.point(rims.lower).x() - meridian.point(all.lower).x() < min_depth) rims.lower = all.lower;
  if (meridian.point(all.upper).x() - meridian.point(rims.upper).x() < min_depth) rims.upper = all.upper;
  return rims;
}

}  // namespace

ArcChain whole(const SampledMeridian& meridian) {
  ArcChain arcs;
  append_curve(arcs, meridian, {0, meridian.last_parameter()});
  return arcs;
}

std::optional<ConvexHull> convex_hull(const SampledMeridian& meridian, HullParts parts) {
  constexpr double rounding_depth = 1e-8;
  const int front = extreme_sample(meridian.points(), 1), rear = extreme_sample(meridian.points(), -1);
  const std::vector<int> samples = hull_samples(meridian.points(), front, rear);
  if (samples.empty() || !std::is_sorted(samples.begin(), samples.end())) return std::nullopt;

  const Interval rims = between_dents(meridian, front, rear);
  ConvexHull hull;
  double reached = rims.lower;
  const Eigen::Vector2d front_rim = meridian.point(rims.lower), rear_rim = meridian.point(rims.upper);
  if (rims.lower > 0) hull.arcs.push_back(chord({front_rim.x(), 0}, front_rim));
  if (parts == HullParts::all) {
    for (const Bridge& bridge : bridges_over(meridian, samples, rims)) {
      append_curve(hull.arcs, meridian, {reached, bridge.start});
      hull.arcs.push_back(chord(meridian.point(bridge.start), meridian.point(bridge.end)));
      hull.flank_bridges += bridge.depth > rounding_depth * meridian.size();
      reached = bridge.end;
    }
  }
  append_curve(hull.arcs, meridian, {reached, rims.upper});
  if (rims.upper < meridian.last_parameter()) hull.arcs.push_back(chord(rear_rim, {rear_rim.x(), 0}));
  return hull;
}

}  // namespace rheocyte
