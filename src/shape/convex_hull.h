// What a camera sees of a contour: the convex hull of the closed curve, as exact parts of the curve and chords.
#pragma once
#include <optional>
#include <vector>

#include "shape/sampled_meridian.h"

namespace rheocyte {

/// The part of a curve piece between two of its parameters; a chord is a piece of degree 1.
struct CurveArc {
  CurvePiece piece;
  double start = 0, end = 1;
};

/// Consecutive arcs from the axis in front to the axis at the rear.
using ArcChain = std::vector<CurveArc>;

enum class HullParts {
  dents_at_poles,  ///< only a dent at the front or rear pole is closed, by a chord across the axis
  all,             ///< concave flanks are bridged, too: the convex hull
};

struct ConvexHull {
  ArcChain arcs;          ///< upper half (r >= 0) of the hull
  int flank_bridges = 0;  ///< chords away from the poles that hide more than rounding (depth > 1e-8 of the size)
};

/// The meridian itself as arcs.
ArcChain whole(const SampledMeridian& meridian);

/// The hull; bridges are found among the samples and their tangency points refined on the curve itself, so area and
/// perimeter are accurate to rounding. Hollows narrower than a sample distance (1/48 of a piece) are not seen.
/// Nothing if the curve winds so strangely that its hull does not follow it from front to rear.
std::optional<ConvexHull> convex_hull(const SampledMeridian& meridian, HullParts parts);

}  // namespace rheocyte
