// The estimates of a block of events by a table of elongated cells.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "infer/elongated_solids.h"

namespace rheocyte {

/// One value per event of a block, NaN without a modulus; all empty without a table of elongated cells.
struct ElongationBlock {
  std::span<const double> modulus_kPa, standard_error_kPa, elongation, elongation_error, axial_tension_Pa,
      axial_tension_error_Pa;
};

/// The values of a block, to be computed.
struct ElongationValues {
  std::vector<double> modulus_kPa, standard_error_kPa, elongation, elongation_error, axial_tension_Pa,
      axial_tension_error_Pa;
  std::vector<ModulusState> states;
  std::vector<ElongatedCell> cells;

  void assign(std::size_t count);
  ElongatedEstimates estimates();
  ElongationBlock block() const;
  /// An event without a modulus, for this reason, has none of the numbers.
  void forget(std::size_t event, ModulusState reason);

 private:
  std::array<std::vector<double>*, 6> all();
};

}  // namespace rheocyte
