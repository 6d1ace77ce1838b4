// The liquid's mesh in a duct, fitted to the cell as it is deformed now (fem/fit_liquid.h).
#pragma once
#include "duct/duct_space.h"

namespace rheocyte {

/// How little the liquid's mesh is distorted from that round the undeformed cell: 1 not at all, 0 folded.
double liquid_mesh_quality(const DuctSpace&, const VectorXd& unknowns);

/// Points for DuctSpace::set_points: where the nodes of the least distorted mesh round the cell would be if they
/// followed it back to its undeformed shape along their spokes.
std::vector<DuctPoint> fitted_points(const DuctSpace&, const VectorXd& unknowns);

/// Points for DuctSpace::set_points: the liquid's nodes are moved as those of the same elements at another degree, or
/// round another cell.
std::vector<DuctPoint> transferred_points(const DuctSpace& from, const DuctSpace& to);

}  // namespace rheocyte
