// Fields of a state in a duct, and the way its mesh is fitted, on another mesh: of another degree, round another cell,
// or of other elements along the side and outward.
#pragma once
#include "duct/duct_space.h"

namespace rheocyte {

/// The same fields in the unknowns of another space, at the same places on the undeformed meshes, whose faces are
/// divided alike across the flow.
VectorXd transfer(const DuctSpace& from, const VectorXd& unknowns, const DuctSpace& to);

/// Points for DuctSpace::set_points: the liquid's nodes are moved as those of such a space, or of one round another
/// cell.
std::vector<DuctPoint> transferred_points(const DuctSpace& from, const DuctSpace& to);

}  // namespace rheocyte
