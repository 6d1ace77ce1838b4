#include "infer/triangulation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "case/user_error.h"
#include "infer/delaunay.h"
#include "numeric/no_value.h"

namespace rheocyte {

namespace {

// scipy's tolerance for "inside": points on the hull belong to it in spite of rounding.
constexpr double inside_tolerance = 100 * std::numeric_limits<double>::epsilon();
// Cells per side of the grid that gives the search its first triangle.
constexpr int grid_side = 512;

double cross(const PlanePoint& o, const PlanePoint& a, const PlanePoint& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

double height_at(const std::vector<PlanePoint>& border, double x) {
  const auto after = std::ranges::lower_bound(border, x, {}, &PlanePoint::x);
  if (after == border.end()) return no_value;
  if (after == border.begin()) return x == after->x ? after->y : no_value;
  const auto before = after - 1;
  return before->y + (after->y - before->y) * (x - before->x) / (after->x - before->x);
}

template <class Object>
void prefetch(const Object& object) {
  constexpr std::size_t cache_line = 64;
  for (std::size_t at = 0; at < sizeof object; at += cache_line)
    __builtin_prefetch(reinterpret_cast<const char*>(&object) + at);
}

// Places along a curve that fills the square, so that neighbours in the plane are neighbours in memory.
std::uint64_t place_on_curve(double x, double y) {
  const auto spread = [](double t) {
    auto bits = static_cast<std::uint64_t>(std::clamp(t, 0.0, 1.0) * 65535);
    std::uint64_t result = 0;
    for (int k = 0; k < 16; ++k) result |= (bits >> k & 1U) << (2 * k);
    return result;
  };
  return spread(x) | spread(y) << 1U;
}

// The triangles of points between min and max, those that are near each other in the plane near each other in memory.
std::vector<std::array<std::int32_t, 3>> along_curve(std::vector<std::array<std::int32_t, 3>> triangles,
                                                     std::span<const PlanePoint> points, PlanePoint min,
                                                     PlanePoint max) {
  using Placed = std::pair<std::uint64_t, std::array<std::int32_t, 3>>;
  std::vector<Placed> placed;
  placed.reserve(triangles.size());
  for (const auto& c : triangles) {
    const double x = (points[c[0]].x + points[c[1]].x + points[c[2]].x) / 3;
    const double y = (points[c[0]].y + points[c[1]].y + points[c[2]].y) / 3;
    placed.emplace_back(place_on_curve((x - min.x) / (max.x - min.x), (y - min.y) / (max.y - min.y)), c);
  }
  std::ranges::sort(placed);
  std::ranges::transform(placed, triangles.begin(), &Placed::second);
  return triangles;
}

}  // namespace

Triangulation::Triangulation(std::span<const PlanePoint> points, std::span<const double> values) {
  assert(points.size() == values.size());
  for (const auto& point : points)
    if (!std::isfinite(point.x) || !std::isfinite(point.y))
      throw UserError("The table has a point that is not finite.");
  make_triangles(points, values);
  if (triangles_.empty())
    throw UserError("The table's points have no triangulation: they are fewer than three or lie on one line.");
  make_borders(points);
  make_start_grid();
}

void Triangulation::make_triangles(std::span<const PlanePoint> points, std::span<const double> values) {
  if (points.size() < 3) return;
  const auto [left, right] = std::ranges::minmax(points, {}, &PlanePoint::x);
  const auto [low, high] = std::ranges::minmax(points, {}, &PlanePoint::y);
  min_ = {left.x, low.y};
  max_ = {right.x, high.y};
  std::vector<Corners> kept;
  for (const Corners& corners : along_curve(delaunay_triangles(points), points, min_, max_)) {
    const auto& [first, second, third] = corners;
    const PlanePoint a = points[first], b = points[second], last = points[third];
    const double determinant = (a.x - last.x) * (b.y - last.y) - (b.x - last.x) * (a.y - last.y);
    if (determinant == 0) {  // three points on a line of the hull; the walk cannot cross what is not there
      has_gaps_ = true;
      continue;
    }
    kept.push_back(corners);
    triangles_.push_back({last,
                          {(b.y - last.y) / determinant, -(b.x - last.x) / determinant, -(a.y - last.y) / determinant,
                           (a.x - last.x) / determinant},
                          {values[first], values[second], values[third]},
                          {-1, -1, -1}});
  }
  find_neighbours(kept);
}

// Both sides of an edge are next to each other once the sides are sorted by the points that they join.
void Triangulation::find_neighbours(std::span<const Corners> corners) {
  struct Side {
    std::uint64_t edge;
    std::int32_t triangle;
    std::uint32_t opposite;
  };
  std::vector<Side> sides;
  sides.reserve(3 * corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(corners[i][(k + 1) % 3], corners[i][(k + 2) % 3]);
      sides.push_back({std::uint64_t(low) << 32U | std::uint64_t(high), std::int32_t(i), k});
    }
  std::ranges::sort(sides, {}, &Side::edge);
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const Side &one = sides[i - 1], &other = sides[i];
    if (one.edge != other.edge) continue;
    triangles_[std::size_t(one.triangle)].neighbours[one.opposite] = other.triangle;
    triangles_[std::size_t(other.triangle)].neighbours[other.opposite] = one.triangle;
  }
}

void Triangulation::make_borders(std::span<const PlanePoint> points) {
  std::vector<PlanePoint> sorted(points.begin(), points.end());
  std::ranges::sort(sorted, [](const auto& a, const auto& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  for (const auto& point : sorted) {
    while (lower_border_.size() > 1 && cross(*(lower_border_.end() - 2), lower_border_.back(), point) <= 0)
      lower_border_.pop_back();
    if (lower_border_.empty() || point.x > lower_border_.back().x) lower_border_.push_back(point);
    while (upper_border_.size() > 1 && cross(*(upper_border_.end() - 2), upper_border_.back(), point) >= 0)
      upper_border_.pop_back();
    if (!upper_border_.empty() && point.x == upper_border_.back().x) upper_border_.pop_back();
    upper_border_.push_back(point);
  }
}

Triangulation::Border Triangulation::border_at(double x) const {
  return {height_at(lower_border_, x), height_at(upper_border_, x)};
}

// Row by row, each cell starts where its neighbour ended.
void Triangulation::make_start_grid() {
  cells_per_x_ = grid_side / (max_.x - min_.x);
  cells_per_y_ = grid_side / (max_.y - min_.y);
  start_grid_.resize(static_cast<std::size_t>(grid_side) * grid_side);
  std::int32_t near = 0;
  std::array<double, 3> weights{};
  for (int j = 0; j < grid_side; ++j) {
    if (j > 0) near = start_grid_[static_cast<std::size_t>(j - 1) * grid_side];
    for (int i = 0; i < grid_side; ++i) {
      const double x = min_.x + (i + 0.5) / cells_per_x_, y = min_.y + (j + 0.5) / cells_per_y_;
      walk(x, y, near, weights);  // outside, it ends at the border, from where the next cell is near, too
      start_grid_[static_cast<std::size_t>(j) * grid_side + i] = near;
    }
  }
}

// Also false for NaN. The margin is that of the tolerance.
bool Triangulation::is_near(double x, double y) const {
  return x >= min_.x - inside_tolerance && x <= max_.x + inside_tolerance && y >= min_.y - inside_tolerance &&
         y <= max_.y + inside_tolerance;
}

std::int32_t Triangulation::start_for(double x, double y) const {
  const int i = std::clamp(static_cast<int>((x - min_.x) * cells_per_x_), 0, grid_side - 1);
  const int j = std::clamp(static_cast<int>((y - min_.y) * cells_per_y_), 0, grid_side - 1);
  return start_grid_[static_cast<std::size_t>(j) * grid_side + i];
}

// Walks across the edge behind which the point lies farthest. In a Delaunay triangulation this ends; rounding in
// slivers could let it go round.
Triangulation::WalkEnd Triangulation::walk(double x, double y, std::int32_t& at, std::array<double, 3>& weights) const {
  constexpr int max_steps = 4096;
  for (int step = 0; step < max_steps; ++step) {
    const Triangle& t = triangles_[at];
    const double dx = x - t.last.x, dy = y - t.last.y;
    weights[0] = t.to_barycentric[0] * dx + t.to_barycentric[1] * dy;
    weights[1] = t.to_barycentric[2] * dx + t.to_barycentric[3] * dy;
    weights[2] = 1 - weights[0] - weights[1];
    const double less = std::min(weights[0], weights[1]);
    if (std::min(less, weights[2]) >= -inside_tolerance) return WalkEnd::inside;
    // The least of them, without a branch that the processor could not foresee.
    const int is_second = weights[1] < weights[0], is_last = weights[2] < less;
    const std::int32_t next = t.neighbours[2 * is_last + (1 - is_last) * is_second];
    if (next < 0) return WalkEnd::border;
    at = next;
  }
  return WalkEnd::lost;
}

double Triangulation::value_at(double x, double y, std::int32_t start) const {
  std::int32_t at = start;
  std::array<double, 3> weights{};
  const WalkEnd end = walk(x, y, at, weights);
  if (end == WalkEnd::lost || (end == WalkEnd::border && has_gaps_))
    at = search_all(x, y, weights);
  else if (end == WalkEnd::border)
    return no_value;
  if (at < 0) return no_value;
  const auto& corner = triangles_[at].values;
  return weights[0] * corner[0] + weights[1] * corner[1] + weights[2] * corner[2];
}

std::int32_t Triangulation::search_all(double x, double y, std::array<double, 3>& weights) const {
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const Triangle& t = triangles_[i];
    const double dx = x - t.last.x, dy = y - t.last.y;
    weights[0] = t.to_barycentric[0] * dx + t.to_barycentric[1] * dy;
    weights[1] = t.to_barycentric[2] * dx + t.to_barycentric[3] * dy;
    weights[2] = 1 - weights[0] - weights[1];
    if (std::ranges::min(weights) >= -inside_tolerance) return static_cast<std::int32_t>(i);
  }
  return -1;
}

// The triangles of a batch are on their way from memory while those before them are walked through.
void Triangulation::interpolate(std::span<const double> x, std::span<const double> y, std::span<double> values) const {
  assert(x.size() == values.size() && y.size() == values.size());
  constexpr std::size_t batch = 32;
  std::array<std::int32_t, batch> starts{};
  for (std::size_t first = 0; first < values.size(); first += batch) {
    const std::size_t count = std::min(batch, values.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      starts[i] = is_near(x[first + i], y[first + i]) ? start_for(x[first + i], y[first + i]) : -1;
      if (starts[i] >= 0) prefetch(triangles_[starts[i]]);
    }
    for (std::size_t i = 0; i < count; ++i)
      values[first + i] = starts[i] < 0 ? no_value : value_at(x[first + i], y[first + i], starts[i]);
  }
}

}  // namespace rheocyte
