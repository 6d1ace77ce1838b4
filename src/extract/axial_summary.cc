#include "extract/axial_summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "numeric/quantile.h"

namespace rheocyte {

namespace {

/// Chi squared over two degrees of freedom that one recording of a hundred exceeds.
constexpr double misfit_by_chance = 4.6;
constexpr double normal_95 = 1.645;  ///< quantile of a normal distribution

/// Its error is that of what it is computed from.
std::string wall_text(double stress_Pa) {
  return fmt::format(
      "of the wall's shear stress of {:.4g} Pa (computed; errors of flow rate, channel and viscosity are not in it)",
      stress_Pa);
}

std::string why_no_law(const AxialSummary& s) {
  const std::size_t cells = s.law.cells;
  if (const std::string majority = s.beyond.majority(cells); !majority.empty())
    return fmt::format("{} than the cells of the table", majority);
  if (cells < fewest_cells_of_population)
    return fmt::format("only {} events have an outline, and it takes {}", cells, fewest_cells_of_population);
  return fmt::format("no population of the table's cells has the outlines of these {} events", cells);
}

std::string tension_line(const AxialSummary& s) {
  const double value = s.law.axial_tension.value_Pa, wall = s.wall_stress_Pa;
  if (s.is_given)
    return fmt::format("axial tension: {:.4g} Pa as given{}", value,
                       std::isfinite(wall) ? fmt::format(", {:.3g} {}", value / wall, wall_text(wall)) : "");
  if (!s.law.is_found)
    return fmt::format(
        "axial tension: not found, because {}; each cell has the one that fits it best, or give --axial-tension-Pa",
        why_no_law(s));
  const auto [lower, upper] = tension_interval_Pa(s.law.axial_tension);
  std::string text = fmt::format(
      "axial tension: {:.4g} Pa (90 % interval {:.4g} to {:.4g}) from {} cells, {:.3g} ({:.3g} to {:.3g}) {}", value,
      lower, upper, s.law.cells, value / wall, lower / wall, upper / wall, wall_text(wall));
  if (lower <= 0 && upper >= 0) text += "; none within its error";
  return text;
}

std::string stiffness_line(const AxialSummary& s) {
  const LawOfCells& law = s.law;
  const auto [lower, upper] = median_interval(law.stiffness);
  std::string text =
      fmt::format("E + E2D/r0: {:.4g} kPa (90 % interval {:.4g} to {:.4g}), the median of the population of {} cells",
                  std::exp(law.stiffness.mean), lower, upper, law.cells);
  if (const std::string shares = s.beyond.shares(law.cells); !shares.empty())
    text += fmt::format(", beyond the table {}", shares);
  if (law.misfit > misfit_by_chance)
    text +=
        fmt::format("; the mean shape differs from that of the model by {:.2g} times its error", std::sqrt(law.misfit));
  return text;
}

}  // namespace

std::pair<double, double> tension_interval_Pa(const AxialTension& tension) {
  return {tension.value_Pa - normal_95 * tension.error_Pa, tension.value_Pa + normal_95 * tension.error_Pa};
}

std::pair<double, double> median_interval(const NumberOfLaw& number) {
  return {std::exp(number.mean - normal_95 * number.error()), std::exp(number.mean + normal_95 * number.error())};
}

std::vector<std::string> law_lines(const AxialSummary& s) {
  if (!s.is_of_elongated_cells) return {};
  std::vector<std::string> lines{tension_line(s)};
  if (s.law.is_found) lines.push_back(stiffness_line(s));
  return lines;
}

std::vector<std::string> slope_lines(const AxialSummary& s) {
  if (!s.is_of_elongated_cells || !s.measured.are_enough()) return {};
  std::string text = fmt::format("slopes between {} cells at equal area ", s.measured.cells);
  if (std::isnan(s.measured.value[0]))
    return {text + "are not known: the second modes of the cells differ less than the pixels make them scatter"};
  const auto& [value, error, cells] = s.measured;
  const PredictedSlopes& predicted = s.predicted;
  text += fmt::format(
      "dc3/dc2, dc4/dc2, dc5/dc2: {:.3f} +- {:.3f}, {:.3f} +- {:.3f}, {:.3f} +- {:.3f}; of cells that differ only in E "
      "+ E2D/r0 {:.2f}, in the part of the cortex in it {:.2f}, in its tension {:.2f}, in the axial tension {:.2f}",
      value[0], error[0], value[1], error[1], value[2], error[2], fmt::join(predicted.by_stiffness, ", "),
      fmt::join(predicted.by_fraction, ", "), fmt::join(predicted.by_ratio, ", "),
      fmt::join(predicted.by_axial_tension, ", "));
  text += are_of_one_tension(s.measured, predicted)
              ? "; the cells differ as those of the model with one axial tension do"
              : "; the cells differ otherwise than those of the model with one axial tension";
  return {text};
}

void SlopeTally::take(const ShapeVector& seen, const ShapeErrors& errors, const CellCoordinates& cell) {
  modes_.push_back(cell_modes(seen - errors.bias));
  noise_ += mode_noise(errors);
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
  summary.measured = slopes_between(modes_, noise_ / double(cells_.size()));
  summary.predicted = predicted_slopes(table, median);
}

}  // namespace rheocyte
