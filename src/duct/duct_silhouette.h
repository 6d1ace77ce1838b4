// What a camera sees of a cell in a duct: the curve on the surface along which it looks past it, and the outline
// (docs/theory-square.md, eq:silhouette).
#pragma once
#include "duct/duct_surface.h"
#include "shape/contour.h"

namespace rheocyte {

/// The silhouette as a meridian from front to rear pole, lengths in h, its place along the flow as in the mesh. In a
/// plane of symmetry it is the meridian there; for other cameras the points whose normals are at right angles to the
/// view. Of a cell off the axis, seen along its offset (from 90 degrees in the mesh), the convex outline.
/// Half of an outline that is symmetric about the axis, as the cell keeps its shape under half a turn about it.
Contour duct_contour(const DuctSpace&, const VectorXd& unknowns, Camera);

/// The surface along the silhouette at parameters in [0, 1] of each piece, front pole first; columns: along it, across.
struct DuctMeridian {
  VectorXd rest_angle;     ///< of the undeformed point, from the flow direction
  Eigen::MatrixX2d point;  ///< (x, distance to the axis)
  Eigen::MatrixX2d stretch;
  Eigen::MatrixX2d curvature;
  Eigen::MatrixX2d principal;  ///< stretches, the least first
};
/// Stretches are those from the shape without stress, a sphere that is stretched so along x.
DuctMeridian duct_meridian(const DuctSpace&, const VectorXd& unknowns, Camera, const VectorXd& parameters,
                           double rest_stretch = 1);

}  // namespace rheocyte
