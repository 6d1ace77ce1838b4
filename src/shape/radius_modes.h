// Cosine modes of an outline's radius about its centroid: what distinguishes an ellipse from a bullet.
#pragma once
#include <array>
#include <vector>

namespace rheocyte {

struct CurveArc;

/// Modes c_k, k = first_radius_mode .. last_radius_mode, of r(theta) = mean radius (1 + sum c_k cos(k theta)), theta =
/// 0 along the flow (docs/theory-extract.md, eq:modes).
inline constexpr int first_radius_mode = 2, last_radius_mode = 7;
using RadiusModes = std::array<double, last_radius_mode - first_radius_mode + 1>;

/// Of the chain and its mirror image at the axis, about the point (centre, 0): c_k = 2 int r cos(k theta) d(theta) /
/// int r d(theta), along the chain, so that an outline that turns back on itself has modes, too.
RadiusModes radius_modes(const std::vector<CurveArc>& arcs, double centre);

}  // namespace rheocyte
