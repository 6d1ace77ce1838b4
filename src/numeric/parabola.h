// Extremes between samples.
#pragma once

namespace rheocyte {

/// The extreme of the parabola through three equidistant values, of which the middle one is the least or the greatest.
inline double vertex(double before, double at, double after) {
  const double slope = (after - before) / 2, curvature = before - 2 * at + after;
  return curvature == 0 ? at : at - slope * slope / (2 * curvature);
}

}  // namespace rheocyte
