// The cell of a combined table whose shape is the median of those of a recording (docs/theory-extract.md, sec. "One
// tension and one stiffness for a recording").
#pragma once
#include <array>

#include "infer/bulk_cortex_fit.h"
#include "infer/seen_cells.h"
#include "numeric/no_value.h"

namespace rheocyte {

/// Numbers alone (store/bytes.h).
struct MedianCell {
  /// ln(area / um2), deformation, Lambda1 / Lambda2 and the modes, without what pixels add to them.
  using Features = std::array<double, feature_count>;

  std::size_t cells = 0;  ///< that were seen; fewer than `min_cells`: nothing else has a meaning
  Features measured{}, fitted{};
  Features error{};  ///< standard errors of one image, which distinguish cells of other kinds from those of the model
  double young_kPa = no_value, young_error_kPa = no_value;
  double cortex_mN_per_m = no_value, cortex_error_mN_per_m = no_value;
  double tension_mN_per_m = no_value, tension_error_mN_per_m = no_value;
  double stiffness_kPa = no_value, stiffness_error_kPa = no_value;  ///< E + E2D / r0
  double effective_modulus_kPa = no_value, effective_modulus_error_kPa = no_value;
  double axial_tension_Pa = no_value, axial_tension_error_Pa = no_value;
  double chi_squared = no_value;
  int freedom = 0;
  bool is_at_end = false;  ///< of the table, beyond which other cells may fit better
  ModuliStatus status = ModuliStatus::no_data;
  static constexpr std::size_t min_cells = 5;
};

/// The median of the cells, fitted with the errors of one picture. The axial tension is fitted, too, unless `tension`
/// tells it. Errors of its numbers grow with the square root of chi2 over its degrees of freedom where that exceeds 1.
MedianCell median_cell(const BulkCortexFit& moduli, const SeenCell& cell, const AxialTension& tension);

}  // namespace rheocyte
