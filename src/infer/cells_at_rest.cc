#include "infer/cells_at_rest.h"

#include "case/problem.h"
#include "case/scales.h"
#include "laws/derivative.h"

namespace rheocyte {

CellsAtRest cells_at_rest(const TableSpec& combined) {
  constexpr double kPa_um3 = 1e-15;  // in J
  const double bending_kBT = combined.bending_ratio > 0 ? 0 : combined.base.cell.cortex.bending_kBT;
  return {poisson_ratio(problem_of(combined.base).cortex), combined.bending_ratio,
          bending_kBT * thermal_energy_J / kPa_um3};
}

CellFunction effective_modulus_kPa(const CellsAtRest& cells, const CellCoordinates& cell, const CombinedState& state) {
  const double log_stiffness = state.value(log_stiffness_row), S = std::exp(log_stiffness);
  const auto [over_stiffness, slope] =
      value_and_slopes([&](const auto& x) { return effective_modulus_over_stiffness(cells, x); },
                       NumbersAtRest<double>{cell(x_radius), log_stiffness, cell(x_fraction), cell(x_ratio)});
  CellCoordinates by = (over_stiffness + slope[1]) * state.gradient.row(log_stiffness_row).transpose();
  by(x_radius) += slope[0], by(x_fraction) += slope[2], by(x_ratio) += slope[3];
  return {over_stiffness * S, S * by};
}

}  // namespace rheocyte
