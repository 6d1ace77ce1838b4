// How an outline lies to the flow: what its mirror image at the flow direction has with the other sign
// (docs/theory-extract.md, eq:tilt).
#pragma once
#include <array>
#include <span>

#include "numeric/no_value.h"
#include "shape/polygon.h"

namespace rheocyte {

/// s_2, s_3, s_4 of r(theta) = mean radius (1 + sum c_k cos(k theta) + s_k sin(k theta)) about the centroid.
using SineModes = std::array<double, 3>;

/// Of the convex hull of a cell: theta = 0 is downstream and theta = 90 degrees where y grows. All are negative if the
/// nose of an elongated cell at a positive y points to the axis.
struct OutlineTilt {
  double sine_mode_2 = no_value, sine_mode_3 = no_value, sine_mode_4 = no_value;
  double flank_slope = no_value;  ///< dy/dx of the line midway between both flanks, x downstream
};

/// Sine modes of the hull's own x- and y-axes, and its flanks, of a cell that moves along x: `direction` 1, or against
/// it: -1.
OutlineTilt outline_tilt(const Polygon& hull, const SineModes& along_x, int direction);

/// Slope dy/dx, x downstream, of the line midway between both flanks of a convex outline from 20 % to 75 % of its
/// length behind its nose: the least-squares line, integrals being exact. NaN without a length.
double flank_slope(const Polygon& hull, int direction);

/// A number of a tilt by the name of its column.
struct TiltFeature {
  const char *name, *sentence;
  double OutlineTilt::*value;
};
std::span<const TiltFeature> tilt_features();

}  // namespace rheocyte
