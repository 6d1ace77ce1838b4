// How the modes of the cells of a recording go together, and what the model says of it: a test of the model, because no
// fit of single cells uses it (docs/theory-extract.md, sec. "One tension for a recording").
#pragma once
#include <array>
#include <vector>

#include "infer/bulk_cortex_fit.h"

namespace rheocyte {

/// dc_3/dc_2, dc_4/dc_2, dc_5/dc_2.
inline constexpr int slope_count = 3;
using ModeSlopes = std::array<double, slope_count>;

/// ln(area) and the modes 2 .. 5 of a cell as it is seen.
struct CellModes {
  double log_area;
  std::array<double, 1 + slope_count> modes;
};
CellModes cell_modes(const ShapeVector& shape);

/// At equal area: each mode against the second one and ln(area), by least squares without cells that are off by more
/// than four standard deviations; the pixels' own scatter, which flattens slopes, is in it: by a third where cells
/// differ as little as those of examples/recordings/combined-cells.toml.
struct SlopesBetweenCells {
  ModeSlopes value{no_value, no_value, no_value}, error{no_value, no_value, no_value};
  std::size_t cells = 0;
};
SlopesBetweenCells slopes_between(const std::vector<CellModes>& cells);

/// Those of cells that differ from this one in the stiffness alone, at equal area, fraction, ratio of the cortex'
/// tension, and axial tension; or in the axial tension alone.
struct PredictedSlopes {
  ModeSlopes by_stiffness, by_tension;
};
PredictedSlopes predicted_slopes(const CombinedInterpolation& table, const CellCoordinates& cell);

}  // namespace rheocyte
