// The shapes of a table's cells as nodes over area and deformation, from its branches.
#pragma once
#include <optional>
#include <span>

#include "table/branch.h"
#include "table/shape_grid.h"
#include "table/stiffness_grid.h"

namespace rheocyte {

inline constexpr int shape_columns = 33, shape_rows = 33;

/// Over the areas of the grid, from the least deformation to the end of the bare surface's smooth states. In each node
/// polynomials in ln(area) run through the states of up to six radii that have its deformation. Nothing if fewer than
/// two radii have it somewhere.
std::optional<ShapeNodes> shapes_from_branches(const GridContent& grid, std::span<const SampledBranch> branches);

}  // namespace rheocyte
