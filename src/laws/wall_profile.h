// The wall of a channel that is not straight: its radius, or half width, as a function of the place
// (docs/theory-time.md, eq:wall, eq:planar-wall).
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace rheocyte {

/// Radii of a channel that is not straight, at places from the start of the cell; constant beyond the ends. Empty:
/// straight. In R, which is the least of the radii. In a duct places are in h, and in place of radii stand half widths
/// over the least one.
struct WallTable {
  std::vector<double> x, radius;
  /// Of a wall that is linear between the places: about so far from each of them its corner is rounded. 0: the wall is
  /// smooth through the places.
  double rounding = 0;
  bool is_straight() const { return x.empty(); }
};

/// From where on the wall no longer changes: a rounded corner has a tail, which falls to 1e-4 there.
inline double last_change(const WallTable& wall) {
  constexpr double tail = 8;  // roundings
  return wall.x.back() + tail * wall.rounding;
}

/// How far the computed channel goes on beyond the reported one: where the wall has slopes, the flow that enters
/// and leaves has the shape of that in a straight tube, which it forgets within about the local radius
/// (docs/theory-time.md, eq:run-out).
inline double run_out(const WallTable& wall) {
  constexpr double longest = 2.5;
  if (wall.is_straight()) return 0;
  const auto [least, greatest] = std::minmax_element(wall.radius.begin(), wall.radius.end());
  return *least == *greatest ? 0 : std::min(*greatest, longest);
}

/// The axial tension of the surroundings (eq:axial-tension) along the way of the cell, over S, linear between the
/// places and constant beyond the ends. Empty: the same everywhere.
struct AxialTensionTable {
  std::vector<double> x, tension;
  bool is_even() const { return x.empty(); }

  double at(double place) const {
    if (place <= x.front()) return tension.front();
    if (place >= x.back()) return tension.back();
    const auto i = std::size_t(std::upper_bound(x.begin(), x.end(), place) - x.begin());
    return std::lerp(tension[i - 1], tension[i], (place - x[i - 1]) / (x[i] - x[i - 1]));
  }
};

/// Cubic pieces through the places of the table, once continuously differentiable, monotonic where the table is
/// (Fritsch and Butland 1984), level at both ends and constant beyond them; or, with a rounding, lines between them
/// that go over into each other (eq:rounded-corner). Lengths in R.
class WallProfile {
 public:
  /// The table must have at least two places, which increase.
  explicit WallProfile(const WallTable& table) : table_(table), slope_(table.x.size(), 0.0) {
    for (std::size_t i = 1; i + 1 < slope_.size(); ++i) {
      const double before = secant(i), after = secant(i + 1);
      const double h = table_.x[i] - table_.x[i - 1], k = table_.x[i + 1] - table_.x[i];
      if (before * after > 0) slope_[i] = 3 * (h + k) / ((2 * k + h) / before + (k + 2 * h) / after);
    }
  }

  double radius(double x) const {
    if (table_.rounding > 0) return rounded(x);
    const auto& at = table_.x;
    if (x <= at.front()) return table_.radius.front();
    if (x >= at.back()) return table_.radius.back();
    const auto i = std::size_t(std::upper_bound(at.begin(), at.end(), x) - at.begin());
    const double h = at[i] - at[i - 1], s = (x - at[i - 1]) / h, t = 1 - s;
    return table_.radius[i - 1] * t * t * (1 + 2 * s) + table_.radius[i] * s * s * (1 + 2 * t) +
           h * s * t * (slope_[i - 1] * t - slope_[i] * s);
  }

 private:
  /// The lines averaged over a neighbourhood, so between the least and the greatest of them.
  double rounded(double x) const {
    double result = table_.radius.front(), slope_before = 0;
    for (std::size_t i = 0; i < table_.x.size(); ++i) {
      const double slope_behind = i + 1 < table_.x.size() ? secant(i + 1) : 0;
      result += (slope_behind - slope_before) * ramp(x - table_.x[i]);
      slope_before = slope_behind;
    }
    return result;
  }
  /// 0 far before a corner, t far behind it.
  double ramp(double t) const {
    constexpr double far = 40;
    const double e = table_.rounding;
    return t > far * e ? t : e * std::log1p(std::exp(t / e));
  }
  /// From the place before i to place i.
  double secant(std::size_t i) const {
    return (table_.radius[i] - table_.radius[i - 1]) / (table_.x[i] - table_.x[i - 1]);
  }

  WallTable table_;
  std::vector<double> slope_;  ///< at the places
};

}  // namespace rheocyte
