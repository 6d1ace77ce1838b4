#include "shape/outline_tilt.h"

#include <algorithm>
#include <utility>

namespace rheocyte {

namespace {

constexpr double flanks_begin = 0.2, flanks_end = 0.75;  // of the length, from the nose

/// Stretch of the x-axis.
struct Stretch {
  double from, to;

  double middle() const { return (from + to) / 2; }
  double length() const { return to - from; }
};

Stretch flanks_of(const Polygon& hull, int direction) {
  double least = 0, most = 0;  // from the first corner
  for (std::size_t i = 0; i < hull.corners(); ++i) {
    least = std::min(least, hull.x()[i]);
    most = std::max(most, hull.x()[i]);
  }
  const double length = most - least;
  if (direction < 0) return {least + flanks_begin * length, least + flanks_end * length};
  return {most - flanks_end * length, most - flanks_begin * length};
}

/// int (x - middle) y |dx| over the part of an edge that lies in the stretch.
double moment_of_edge(const Polygon& hull, std::size_t i, const Stretch& stretch) {
  double x1 = hull.x()[i], x2 = hull.x()[i + 1], y1 = hull.y()[i], y2 = hull.y()[i + 1];
  if (x1 > x2) std::swap(x1, x2), std::swap(y1, y2);
  const Stretch part{std::max(x1, stretch.from), std::min(x2, stretch.to)};
  if (!(part.length() > 0)) return 0;
  const double slope = (y2 - y1) / (x2 - x1), y = y1 + slope * (part.middle() - x1);
  const double arm = part.middle() - stretch.middle(), square = part.length() * part.length() / 12;
  return part.length() * (arm * y + slope * square);
}

constexpr TiltFeature all_tilt_features[] = {
    {"sine_mode_2",
     "sine mode s_2 of the hull's radius about its centroid, counted from downstream towards growing pos_y",
     &OutlineTilt::sine_mode_2},
    {"flank_slope", "slope dy/dx, x downstream, of the line midway between the two flanks of the hull",
     &OutlineTilt::flank_slope},
    {"sine_mode_3", "its sine mode s_3", &OutlineTilt::sine_mode_3},
    {"sine_mode_4", "its sine mode s_4", &OutlineTilt::sine_mode_4}};

}  // namespace

double flank_slope(const Polygon& hull, int direction) {
  const Stretch flanks = flanks_of(hull, direction);
  if (!(flanks.length() > 0)) return no_value;
  double moment = 0;
  for (std::size_t i = 0; i < hull.corners(); ++i) moment += moment_of_edge(hull, i, flanks);
  // The line midway has half the sum of both flanks.
  const double inertia = flanks.length() * flanks.length() * flanks.length() / 12;
  return direction * moment / 2 / inertia;
}

// Downstream is -x: theta becomes 180 degrees - theta.
OutlineTilt outline_tilt(const Polygon& hull, const SineModes& along_x, int direction) {
  return {direction * along_x[0], along_x[1], direction * along_x[2], flank_slope(hull, direction)};
}

std::span<const TiltFeature> tilt_features() { return all_tilt_features; }

}  // namespace rheocyte
