// A combined table of elongated cells in another liquid than the one for which it was computed.
#pragma once
#include "infer/cells_at_rest.h"
#include "table/combined_interpolation.h"

namespace rheocyte {

/// What a liquid changes in the states of a table, by two tables of cells with the same proportions of bulk, cortex and
/// tension in both liquids: the differences of every feature and of ln S at equal size, progress and axial tension over
/// the effective modulus (docs/theory-tables.md, eq:liquid-of-a-table). At equal shapes they hardly depend on the
/// proportions. Beyond the last cell of the two tables the differences stay as they are there.
class LiquidChange {
 public:
  /// Elongated tables of the tube in channels of one width, with one fraction and one tension of the cortex each. They
  /// must outlive it.
  LiquidChange(const CombinedInterpolation& computed, const CombinedInterpolation& requested);

  /// The table, of a channel of the same width, in the liquid and at the flow rate of `requested`.
  CombinedTable changed(const CombinedTable& table) const;

 private:
  /// Slopes are by ln of the progress.
  struct Difference {
    Eigen::Matrix<double, row_count, 1> value, slope;
  };
  Difference at(CellCoordinates cell) const;
  CombinedBranch changed(const CombinedBranch& branch, double progress_of_unit, const CellsAtRest& at_rest,
                         double log_modulus) const;

  const CombinedInterpolation &computed_, &requested_;
  CellsAtRest at_rest_;  ///< of their cells
};

}  // namespace rheocyte
