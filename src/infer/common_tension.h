// The tension of the liquid along the flow that all cells of a recording have in common: that of the population to
// which its cells belong (docs/theory-extract.md, sec. "One tension for a recording").
#pragma once
#include <cstddef>

#include "infer/combined_population.h"

namespace rheocyte {

/// Numbers alone (store/bytes.h).
struct CommonTension {
  double value_Pa = no_value, lower_Pa = no_value, upper_Pa = no_value;  ///< with the 90 % interval
  double misfit = no_value;  ///< chi squared of the mean features per degree of freedom
  std::size_t cells = 0;     ///< from which it follows, or would have followed

  bool is_found() const { return value_Pa == value_Pa; }
  /// With its standard error; unknown if it is not found.
  AxialTension tension() const;
};

/// Of a population fitted to so many cells. The interval contains the scatter of the cells and what table, section and
/// what these miss leave.
CommonTension common_tension(const CombinedPopulation& population, std::size_t cells, double wall_stress_Pa);

}  // namespace rheocyte
