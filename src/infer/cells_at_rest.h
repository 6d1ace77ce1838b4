// The effective Young's modulus of cells of a combined table (docs/theory-analytic.md, eq:effective-modulus), from the
// numbers that are fitted: stiffness, radius, fraction of the cortex in the stiffness, tension of the cortex over E2D.
#pragma once
#include <array>
#include <cmath>

#include "analytic/effective_modulus.h"
#include "case/channel_flow.h"
#include "laws/constant.h"
#include "table/combined_interpolation.h"

namespace rheocyte {

/// What all cells of a table have in common at rest.
struct CellsAtRest {
  double poisson_ratio = 0.5;  ///< of the cortex
  double bending_ratio = 0;    ///< bending stiffness over S r0^3
  double bending_kPa_um3 = 0;  ///< or the same for all

  /// In a channel and flow that these factors lead to.
  CellsAtRest scaled(const ScaleFactors& to) const {
    return {poisson_ratio, bending_ratio, bending_kPa_um3 * to.modulus * to.volume};
  }
};
CellsAtRest cells_at_rest(const TableSpec& combined);

/// ln(r0 / um), ln(S / kPa), fraction, tension ratio.
template <class T>
using NumbersAtRest = std::array<T, 4>;

/// Over S.
template <class T>
T effective_modulus_over_stiffness(const CellsAtRest& cells, const NumbersAtRest<T>& x) {
  using std::exp;
  const auto& [log_radius, log_stiffness, fraction, ratio] = x;
  const T bending = cells.bending_ratio + cells.bending_kPa_um3 * exp(-(log_stiffness + 3.0 * log_radius));
  return effective_modulus<T>(
      {1.0 - fraction, fraction, constant<T>(cells.poisson_ratio), ratio * fraction, bending, constant<T>(1)});
}

/// Of a cell in the table's channel and flow.
CellFunction effective_modulus_kPa(const CellsAtRest& cells, const CellCoordinates& cell, const CombinedState& state);

}  // namespace rheocyte
