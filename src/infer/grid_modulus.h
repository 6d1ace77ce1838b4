// Young's modulus of each event with its standard error, from a grid of rheocyte's own tables (docs/theory-extract.md,
// sec. "own tables").
#pragma once
#include <span>

#include "infer/modulus_parity.h"
#include "infer/modulus_state.h"
#include "table/stiffness_grid.h"

namespace rheocyte {

/// One value per event, spans of one length.
struct EstimatedModuli {
  std::span<double> modulus_kPa;         ///< NaN without a modulus
  std::span<double> standard_error_kPa;  ///< of pixels and of the table
  std::span<ModulusState> state;
};

class GridModulus {
 public:
  /// UserError if the grid's stiffness is not Young's modulus.
  explicit GridModulus(GridContent grid);

  const GridOrigin& origin() const { return grid_.origin(); }
  const StiffnessGrid& grid() const { return grid_; }

  /// Area and deformation less what the pixels do (unless the pixel size is 0), area and modulus scaled to the table's
  /// channel, flow and viscosity (eq:scaling), the grid between; the standard error from the scatter by pixels and the
  /// table's error (eq:standard-error). Spans of one length (asserted).
  void estimate(const MeasuringConditions& conditions, const MeasuredEvents& events,
                const EstimatedModuli& estimates) const;

 private:
  struct Block;
  void estimate_block(const MeasuringConditions& conditions, const Block& block,
                      const EstimatedModuli& estimates) const;

  StiffnessGrid grid_;
};

}  // namespace rheocyte
