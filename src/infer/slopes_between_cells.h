// How the modes of the cells of a recording go together, and what the model says of it: a test of the model, because no
// fit of single cells uses it (docs/theory-extract.md, sec. "One tension and one stiffness for a recording").
#pragma once
#include <array>
#include <vector>

#include "infer/bulk_cortex_fit.h"

namespace rheocyte {

/// dc_3/dc_2, dc_4/dc_2, dc_5/dc_2.
inline constexpr int slope_count = 3;
using ModeSlopes = std::array<double, slope_count>;

/// ln(area) and the modes 2 .. 5 of a cell.
using CellModes = Eigen::Matrix<double, 2 + slope_count, 1>;
using ModeNoise = Eigen::Matrix<double, CellModes::RowsAtCompileTime, CellModes::RowsAtCompileTime>;
CellModes cell_modes(const ShapeVector& shape);
ModeNoise mode_noise(const ShapeErrors& errors);

/// At equal area: each mode against the second one and ln(area), by least squares without cells that are off by more
/// than four standard deviations. The scatter of the pictures, which flattens slopes, is taken off the sums
/// (eq:slopes-between-cells); a tenth of what that changes counts as an error. No values where the second modes of the
/// cells scatter less than those of their pictures.
struct SlopesBetweenCells {
  ModeSlopes value{no_value, no_value, no_value}, error{no_value, no_value, no_value};
  std::size_t cells = 0;

  static constexpr std::size_t min_cells = 20;
  bool are_enough() const { return cells >= min_cells; }
};
/// `noise`: covariance of what a picture adds, the mean of all cells.
SlopesBetweenCells slopes_between(const std::vector<CellModes>& cells, const ModeNoise& noise = ModeNoise::Zero());

/// Those of cells that differ from this one, at equal area, in one of these alone: E + E2D/r0, the part of the cortex
/// in it, the tension of the cortex over its modulus, and the axial tension.
struct PredictedSlopes {
  ModeSlopes by_stiffness, by_fraction, by_ratio, by_axial_tension;
};
PredictedSlopes predicted_slopes(const CombinedInterpolation& table, const CellCoordinates& cell);

/// Whether the slopes are those of cells with one axial tension that differ in the other three independently of each
/// other: a mean of these, with any weights, each within three standard errors and 0.1, as lines are not straight.
bool are_of_one_tension(const SlopesBetweenCells& measured, const PredictedSlopes& predicted);

}  // namespace rheocyte
