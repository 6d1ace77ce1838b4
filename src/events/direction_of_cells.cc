#include "events/direction_of_cells.h"

#include <algorithm>
#include <cmath>

#include "events/plausibility.h"
#include "measurement/contour_features.h"

namespace rheocyte {

namespace {

constexpr std::size_t outlines_looked_at = 1024, at_a_time = 64;  // events

}  // namespace

int direction_of_cells(EventOutlines& outlines, double sign) {
  const std::size_t events = outlines.events(), pieces = std::min(outlines_looked_at, events) / at_a_time + 1;
  ContourMeasurer measurer;
  double sum = 0, squares = 0, count = 0;
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    const std::size_t first = piece * events / pieces, last = std::min(first + at_a_time, events);
    for (std::size_t event = first; event < last; ++event) {
      const PixelContour contour = outlines.outline(event);
      if (contour.size() < fewest_outline_points || outlines.is_cut(contour)) continue;
      const Polygon& hull = measurer.find_hull(contour);
      const HullAsymmetry shape = hull_asymmetry(hull);
      const double c = shape.mode_3, area_um2 = hull.moments().area * outlines.pixel_um() * outlines.pixel_um();
      if (!(std::abs(c) < 0.3) || is_red_cell(shape.inertia_ratio(), area_um2)) continue;
      sum += c;
      squares += c * c;
      ++count;
    }
  }
  if (count < 2) return 0;
  const double mean = sum / count, error = std::sqrt(std::max(0.0, squares / count - mean * mean) / count);
  if (!(std::abs(mean) > 2 * error)) return 0;
  return mean * sign > 0 ? 1 : -1;
}

std::string_view direction_text(int direction) {
  if (direction == 0) return "unknown, taken as +x";
  return direction > 0 ? "+x" : "-x";
}

}  // namespace rheocyte
