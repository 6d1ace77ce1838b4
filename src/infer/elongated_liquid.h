// A table of elongated cells in the liquid of a recording, which may be another one than the table's.
#pragma once
#include "infer/elongated_solids.h"

namespace rheocyte {

/// All that it refers to must outlive it.
class ElongatedLiquid {
 public:
  /// `computed` and `measured`: tables of the same cells, not elongated, in the liquid of the elongated ones and in
  /// that of the recording; null where both liquids are the same. At equal size and effective viscosity the modulus of
  /// the elongated cell changes as that of the cell that it would be without the elongation.
  ElongatedLiquid(const ElongatedSolids& solids, const ModulusMap* computed, const ModulusMap* measured)
      : solids_(solids), computed_(computed), measured_(measured) {}

  const ElongatedSolids& solids() const { return solids_; }
  void estimate(const MeasuringConditions& conditions, const MeasuredEvents& events, const ElongatedShapes& shapes,
                const ElongatedEstimates& estimates) const;
  /// Modulus of a cell of the table in the recording's liquid over that in the table's.
  double modulus_ratio(const ElongatedCell& cell) const;

 private:
  const ElongatedSolids& solids_;
  const ModulusMap *computed_, *measured_;
};

}  // namespace rheocyte
