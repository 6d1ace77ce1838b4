// The liquid's mesh in a duct, fitted to the cell as it is deformed now (fem/fit_liquid.h).
#pragma once
#include "duct/duct_space.h"

namespace rheocyte {

/// How little the liquid's mesh is distorted from that round the undeformed cell: 1 not at all, 0 folded.
double liquid_mesh_quality(const DuctSpace&, const VectorXd& unknowns);

/// Points for DuctSpace::set_points: where the nodes of the least distorted mesh round the cell would be if they
/// followed it back to its undeformed shape along their spokes.
std::vector<DuctPoint> fitted_points(const DuctSpace&, const VectorXd& unknowns);

/// Heights between elements along the side: `evenly` = 0 as they are, 1 even on the deformed cell, as
/// RequestedElements has it on all meridians in planes of symmetry.
std::vector<double> fitted_breaks(const DuctSpace&, const VectorXd& unknowns, double evenly);

/// How even they are.
double surface_evenness(const DuctSpace&, const VectorXd& unknowns);

}  // namespace rheocyte
