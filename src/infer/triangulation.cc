#include "infer/triangulation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

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
  least_ = {left.x, low.y};
  greatest_ = {right.x, high.y};
  auto corners = delaunay_triangles(points);
  std::ranges::sort(corners, {}, [&](const auto& c) {
    const double x = (points[c[0]].x + points[c[1]].x + points[c[2]].x) / 3;
    const double y = (points[c[0]].y + points[c[1]].y + points[c[2]].y) / 3;
    return place_on_curve((x - least_.x) / (greatest_.x - least_.x), (y - least_.y) / (greatest_.y - least_.y));
  });
  std::map<std::pair<std::int32_t, std::int32_t>, std::pair<std::int32_t, int>> open_edges;
  for (const auto& c : corners) {
    const PlanePoint a = points[c[0]], b = points[c[1]], last = points[c[2]];
    const double determinant = (a.x - last.x) * (b.y - last.y) - (b.x - last.x) * (a.y - last.y);
    if (determinant == 0) {  // three points on a line of the hull; the walk cannot cross what is not there
      has_gaps_ = true;
      continue;
    }
    const auto number = static_cast<std::int32_t>(triangles_.size());
    triangles_.push_back({last,
                          {(b.y - last.y) / determinant, -(b.x - last.x) / determinant, -(a.y - last.y) / determinant,
                           (a.x - last.x) / determinant},
                          {values[c[0]], values[c[1]], values[c[2]]},
                          {-1, -1, -1}});
    for (int k = 0; k < 3; ++k) {
      const auto edge = std::minmax(c[(k + 1) % 3], c[(k + 2) % 3]);
      const auto [there, is_new] = open_edges.try_emplace(edge, number, k);
      if (is_new) continue;
      const auto [other, opposite] = there->second;
      triangles_[number].neighbours[k] = other;
      triangles_[other].neighbours[opposite] = number;
    }
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
  cells_per_x_ = grid_side / (greatest_.x - least_.x);
  cells_per_y_ = grid_side / (greatest_.y - least_.y);
  start_grid_.resize(static_cast<std::size_t>(grid_side) * grid_side);
  std::int32_t near = 0;
  std::array<double, 3> weights{};
  for (int j = 0; j < grid_side; ++j) {
    if (j > 0) near = start_grid_[static_cast<std::size_t>(j - 1) * grid_side];
    for (int i = 0; i < grid_side; ++i) {
      const double x = least_.x + (i + 0.5) / cells_per_x_, y = least_.y + (j + 0.5) / cells_per_y_;
      const std::int32_t found = locate(x, y, near, weights);
      if (found >= 0) near = found;
      start_grid_[static_cast<std::size_t>(j) * grid_side + i] = near;
    }
  }
}

std::int32_t Triangulation::start_for(double x, double y) const {
  const int i = std::clamp(static_cast<int>((x - least_.x) * cells_per_x_), 0, grid_side - 1);
  const int j = std::clamp(static_cast<int>((y - least_.y) * cells_per_y_), 0, grid_side - 1);
  return start_grid_[static_cast<std::size_t>(j) * grid_side + i];
}

// Walks across the edge behind which the point lies farthest. In a Delaunay triangulation this ends; rounding in
// slivers could let it go round, then every triangle is tried.
std::int32_t Triangulation::locate(double x, double y, std::int32_t start, std::array<double, 3>& weights) const {
  constexpr int max_steps = 4096;
  std::int32_t at = start;
  for (int step = 0; step < max_steps; ++step) {
    const Triangle& t = triangles_[at];
    const double dx = x - t.last.x, dy = y - t.last.y;
    weights[0] = t.to_barycentric[0] * dx + t.to_barycentric[1] * dy;
    weights[1] = t.to_barycentric[2] * dx + t.to_barycentric[3] * dy;
    weights[2] = 1 - weights[0] - weights[1];
    int worst = weights[1] < weights[0] ? 1 : 0;
    if (weights[2] < weights[worst]) worst = 2;
    if (weights[worst] >= -inside_tolerance) return at;
    at = t.neighbours[worst];
    if (at < 0) return has_gaps_ ? search_all(x, y, weights) : -1;
  }
  return search_all(x, y, weights);
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

void Triangulation::interpolate(std::span<const double> x, std::span<const double> y, std::span<double> values) const {
  assert(x.size() == values.size() && y.size() == values.size());
  std::array<double, 3> weights{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    // Also false for NaN. The margin is that of the tolerance.
    const bool near = x[i] >= least_.x - inside_tolerance && x[i] <= greatest_.x + inside_tolerance &&
                      y[i] >= least_.y - inside_tolerance && y[i] <= greatest_.y + inside_tolerance;
    const std::int32_t at = near ? locate(x[i], y[i], start_for(x[i], y[i]), weights) : -1;
    if (at < 0) {
      values[i] = no_value;
      continue;
    }
    const auto& corner = triangles_[at].values;
    values[i] = weights[0] * corner[0] + weights[1] * corner[1] + weights[2] * corner[2];
  }
}

}  // namespace rheocyte
