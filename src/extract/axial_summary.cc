#include "extract/axial_summary.h"

#include <fmt/format.h>

#include <cmath>

#include "numeric/quantile.h"

namespace rheocyte {

namespace {

/// The prediction counts as met within so many standard errors and this much of the slope: fractions and tensions of
/// the cells differ, too.
constexpr double errors_allowed = 3, slope_allowed = 0.1;

/// Its error is that of what it is computed from.
std::string wall_text(double stress_Pa) {
  return fmt::format(
      "of the wall's shear stress of {:.4g} Pa (computed; errors of flow rate, channel and viscosity are not in it)",
      stress_Pa);
}

bool is_near(double value, double error, double predicted) {
  return std::abs(value - predicted) < errors_allowed * error + slope_allowed;
}

}  // namespace

std::vector<std::string> tension_lines(const AxialSummary& s) {
  if (!s.is_of_elongated_cells) return {};
  const auto& [value, lower, upper, misfit, cells] = s.common;
  const double wall = s.wall_stress_Pa;
  if (s.is_given)
    return {fmt::format("axial tension: {:.4g} Pa as given{}", value,
                        std::isfinite(wall) ? fmt::format(", {:.3g} {}", value / wall, wall_text(wall)) : "")};
  if (!s.common.is_found())
    return {
        fmt::format("axial tension: not found, because only {} events have the shape of a cell of the table, and "
                    "it takes {}; each cell has the one that fits it best, or give --axial-tension-Pa",
                    cells, CommonTension::min_cells)};
  std::string text = fmt::format(
      "axial tension: {:.4g} Pa (90 % interval {:.4g} to {:.4g}) from {} cells, {:.3g} ({:.3g} to {:.3g}) {}", value,
      lower, upper, cells, value / wall, lower / wall, upper / wall, wall_text(wall));
  if (lower <= 0 && upper >= 0) text += "; none within its error";
  if (misfit > 2)
    text += fmt::format("; the shapes differ from those of the model by {:.2g} times their errors", std::sqrt(misfit));
  return {text};
}

std::vector<std::string> slope_lines(const AxialSummary& s) {
  if (!s.is_of_elongated_cells || std::isnan(s.measured.value[0])) return {};
  std::string text = fmt::format("slopes between {} cells at equal area:", s.measured.cells);
  bool is_met = true;
  for (std::size_t k = 0; k < slope_count; ++k) {
    const double value = s.measured.value[k], error = s.measured.error[k], stiffness = s.predicted.by_stiffness[k];
    text += fmt::format(
        "{} dc{}/dc2 = {:.3f} +- {:.3f} (cells that differ in stiffness alone: {:.2f}, in axial "
        "tension alone: {:.2f})",
        k == 0 ? "" : ",", k + 3, value, error, stiffness, s.predicted.by_tension[k]);
    is_met = is_met && is_near(value, error, stiffness);
  }
  text += is_met ? "; the cells differ as those of the model with one axial tension do"
                 : "; the cells differ otherwise than those of the model with one axial tension";
  return {text};
}

void SlopeTally::take(const ShapeVector& seen, const CellCoordinates& cell) {
  modes_.push_back(cell_modes(seen));
  cells_.push_back(cell);
}

void SlopeTally::finish(const CombinedInterpolation& table, AxialSummary& summary) const {
  if (cells_.empty()) return;
  CellCoordinates median;
  for (int x = 0; x < coordinate_count; ++x) {
    std::vector<double> along;
    for (const auto& cell : cells_) along.push_back(cell(x));
    median(x) = quantile(along, 0.5);
  }
  summary.measured = slopes_between(modes_);
  summary.predicted = predicted_slopes(table, median);
}

}  // namespace rheocyte
