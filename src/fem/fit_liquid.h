// The liquid's mesh, fitted to the cell as it is deformed now (docs/theory.md, eq:distortion).
#pragma once
#include "fem/discretisation.h"

namespace rheocyte {

/// Between elements on top: `evenly` = 0 as they are, 1 even on the deformed cell, by their length and by the angle
/// that the surface turns along them.
SurfaceBreaks fitted_breaks(const Discretisation&, const VectorXd& unknowns, double evenly = 1);

/// How even they are: 1 over the number of even elements that the most loaded one stands for.
double surface_evenness(const Discretisation&, const VectorXd& unknowns);

/// How little the liquid's mesh is distorted from that round the undeformed cell: 1 not at all, 0 folded.
double liquid_mesh_quality(const Discretisation&, const VectorXd& unknowns);

/// Where the nodes of the least distorted mesh round the cell would be if they followed it back to its undeformed shape
/// along their spokes: points for Discretisation::set_points. Those of the cell are as they are.
std::vector<Point> fitted_points(const Discretisation&, const VectorXd& unknowns);

}  // namespace rheocyte
