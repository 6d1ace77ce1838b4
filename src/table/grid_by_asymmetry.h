// The grid of a table with the asymmetry of the outline in place of the deformation.
#pragma once
#include <optional>

#include "table/shape_grid.h"
#include "table/stiffness_grid.h"

namespace rheocyte {

/// A grid whose rows are at equal distances of ln|c_3|, from the least deformation to the end of the smooth states of
/// the bare surface, or to where the asymmetry is the greatest. Nothing if it does not rise everywhere.
std::optional<GridContent> grid_by_asymmetry(const StiffnessGrid& grid, const ShapeGrid& shapes);

}  // namespace rheocyte
