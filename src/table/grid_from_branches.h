// A structured grid of the stiffness from the branches of a table (docs/tables.md, sec. "grid").
#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "table/branch.h"
#include "table/stiffness_grid.h"
#include "table/table_spec.h"

namespace rheocyte {

struct GridResolution {
  int columns = 128, rows = 112, regularised_rows = 40;  ///< held: of the patch that bending holds smooth
};

/// Lines of equal height between the borders cross every branch; through their crossings run polynomials in ln(area).
/// Nothing if the branches are too few or too short for a grid.
std::optional<GridContent> make_stiffness_grid(const TableSpec& spec, std::span<const SampledBranch> branches,
                                               std::string_view version, const GridResolution& resolution = {});

}  // namespace rheocyte
