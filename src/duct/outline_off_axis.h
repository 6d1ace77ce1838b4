// Outlines of cells off the axis, which are no lines of the mesh (docs/theory-square.md, sec. "Cells off the axis").
#pragma once
#include <cmath>
#include <numbers>

#include "duct/duct_surface.h"
#include "shape/contour.h"

namespace rheocyte {

/// Of half an outline.
inline constexpr int off_axis_pieces = 48;

/// Direction of the outline's normal in the image plane of x and `across`, 0 in front.
inline DuctPoint outline_direction(const DuctPoint& across, double angle) {
  return std::cos(angle) * DuctPoint::UnitX() + std::sin(angle) * across;
}

/// Half of an outline that is symmetric.
Contour off_axis_contour(const DuctSurfaceMap& surface, const DuctPoint& across);

/// Convex outline of a cell off the axis in the plane of the flow and its offset, which a camera at right angles to
/// both sees: a closed polygon from the front on, counterclockwise, (x, y along the offset) in h, as in the mesh. Its
/// corners lie on parabolas between the places that lie farthest in 96 directions.
Eigen::MatrixX2d duct_offset_outline(const DuctSpace&, const VectorXd& unknowns);

}  // namespace rheocyte
