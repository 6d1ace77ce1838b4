// The tension of the liquid along the flow that all cells of a recording have in common, from their shapes
// (docs/theory-extract.md, sec. "One tension for a recording").
#pragma once
#include <functional>
#include <span>

#include "infer/seen_cells.h"

namespace rheocyte {

struct CommonTension {
  double value_Pa = no_value, lower_Pa = no_value, upper_Pa = no_value;  ///< with the 90 % interval
  double misfit = no_value;                                              ///< chi squared per degree of freedom
  std::size_t cells = 0;  ///< that the table has at this tension; fewer than `min_cells`: no value
  static constexpr std::size_t min_cells = 10;

  bool is_found() const { return cells >= min_cells && value_Pa == value_Pa; }
  /// With its standard error; unknown if it is not found.
  AxialTension tension() const;
  /// The interval with another standard error that all cells share.
  void widen(double error_Pa);
};

/// Where the sum of chi squared over the cells, or groups of them (means_by_size), is least, each with the moduli that
/// fit it best at this tension. The fraction of each in the sum is bounded: a few that are no cells of the model hardly
/// move it. `goes_on` is called from one to the next.
CommonTension common_tension(
    const BulkCortexFit& moduli, std::span<const SeenCell> cells, const std::function<void()>& goes_on = [] {});

}  // namespace rheocyte
