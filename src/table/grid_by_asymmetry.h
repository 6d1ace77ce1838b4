// The grid of a table with the asymmetry of the outline in place of the deformation.
#pragma once
#include <optional>

#include "table/shape_grid.h"
#include "table/stiffness_grid.h"

namespace rheocyte {

/// Grids whose rows are at equal distances of ln|c_3|, from the least deformation to the end of the smooth states of
/// the bare surface, or to where the asymmetry is the greatest.
struct GridsByAsymmetry {
  GridContent stiffness;
  GridContent mode_2;  ///< c_2 in place of ln(stiffness)
};

/// Nothing if the asymmetry does not rise everywhere.
std::optional<GridsByAsymmetry> grids_by_asymmetry(const StiffnessGrid& grid, const ShapeGrid& shapes);

}  // namespace rheocyte
