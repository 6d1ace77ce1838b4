#include "extract/moduli_summary.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <utility>

namespace rheocyte {

namespace {

std::string range_text(const Distribution& d, std::string_view name, std::string_view unit) {
  return fmt::format(", {} median {} {} (quartiles {:.4g} to {:.4g})", name, median_text(d), unit, d.first_quartile,
                     d.third_quartile);
}

Distribution distribution_of(const NumberOfLaw& number) {
  constexpr double normal_75 = 0.6745;  // quantile of a normal distribution
  const double half_width = normal_75 * number.spread, median = std::exp(number.mean);
  Distribution d;
  d.median = median, d.median_error = median * number.error();
  d.first_quartile = median * std::exp(-half_width), d.third_quartile = median * std::exp(half_width);
  return d;
}

}  // namespace

std::size_t ModuliSummary::events() const { return std::accumulate(counts.begin(), counts.end(), std::size_t{0}); }

void ModuliTally::take(const ModuliEstimate& e) {
  ++summary_.counts[std::size_t(e.status)];
  if (e.status == ModuliStatus::resolved) {
    young_.push_back(e.value(Modulus::young));
    cortex_.push_back(e.value(Modulus::cortex));
  }
  if (e.status == ModuliStatus::resolved || e.status == ModuliStatus::not_told_apart) {
    stiffness_.push_back(e.stiffness_kPa);
    effective_modulus_.push_back(e.effective_modulus_kPa);
  }
}

ModuliSummary ModuliTally::summary(const CommonErrors& of_single_cells, const LawOfCells& law) {
  const CommonErrors common =
      law.is_found ? CommonErrors{law.young.error(), law.cortex.error(), no_value, no_value} : of_single_cells;
  const auto with_common = [](const std::vector<double>& values, double relative) {
    Distribution d = distribution_of(values);
    if (std::isfinite(relative)) d.median_error = std::hypot(d.median_error, relative * d.median);
    return d;
  };
  summary_.young_kPa = with_common(young_, common.young);
  summary_.cortex_mN_per_m = with_common(cortex_, common.cortex);
  summary_.stiffness_kPa = law.is_found ? distribution_of(law.stiffness) : with_common(stiffness_, common.stiffness);
  summary_.effective_modulus_kPa =
      law.is_found ? distribution_of(law.effective_modulus) : with_common(effective_modulus_, common.effective_modulus);
  return summary_;
}

namespace {

/// Events that were fitted and have no stiffness.
std::size_t missing(const ModuliSummary& s) {
  const auto count = [&](ModuliStatus status) { return s.counts[std::size_t(status)]; };
  return count(ModuliStatus::outside_table) + count(ModuliStatus::poor_fit);
}

/// Whether medians of single cells are those of the minority that lies in the table.
bool is_of_minority(const ModuliSummary& s) { return missing(s) > s.with_stiffness(); }

}  // namespace

std::string missing_text(const ModuliSummary& s) {
  if (s.with_stiffness() == 0 || !is_of_minority(s)) return {};
  return fmt::format(
      "only {} of {} fitted events have a stiffness: medians of single cells are those of cells that happen to be in "
      "the table, not of all; report {}.",
      s.with_stiffness(), s.with_stiffness() + missing(s),
      s.axial.law.is_found ? "only E + E2D/r0 of the population" : "none of them");
}

std::string in_one_line(const ModuliSummary& s) {
  std::string text = fmt::format("{} of {} events {}", s.resolved(), s.events(), name_of(ModuliStatus::resolved));
  if (s.resolved() > 0) text += range_text(s.young_kPa, "E", "kPa") + range_text(s.cortex_mN_per_m, "E2D", "mN/m");
  if (s.has_stiffness()) text += range_text(s.stiffness_kPa, "E + E2D/r0", "kPa");
  if (s.has_stiffness() && !s.axial.is_of_elongated_cells)
    text += range_text(s.effective_modulus_kPa, "effective E", "kPa");
  std::string others;
  for (int k = 0; k < moduli_status_count; ++k)
    if (const auto status = ModuliStatus(k); status != ModuliStatus::resolved && s.counts[std::size_t(k)] > 0)
      others += fmt::format("{}{} {}", others.empty() ? "; " : ", ", s.counts[std::size_t(k)], name_of(status));
  return text + others;
}

namespace {

/// Of the median cell by a table of elongated cells; empty if too few were seen.
std::string median_line(const ModuliSummary& s) {
  const MedianCell& m = s.median_cell;
  if (!s.axial.is_of_elongated_cells || m.cells < MedianCell::min_cells) return {};
  if (m.status == ModuliStatus::no_data)
    return fmt::format("the median outline of {} cells: none of the table's cells has it", m.cells);
  return fmt::format(
      "the median outline of {} cells{}: E {:.3g} +- {:.2g} kPa, E2D {:.3g} +- {:.2g} mN/m, tension {:.3g} +- {:.2g} "
      "mN/m, effective Young's modulus {:.3g} +- {:.2g} kPa, axial tension {:.3g} +- {:.2g} Pa, {:.3g} +- {:.2g} of "
      "the wall's shear stress{}",
      m.cells,
      m.status == ModuliStatus::outside_table ? ", beyond the table, which is continued to it"
      : m.is_at_end                           ? ", at the end of the table, beyond which other cells may fit better"
                                              : "",
      m.young_kPa, m.young_error_kPa, m.cortex_mN_per_m, m.cortex_error_mN_per_m, m.tension_mN_per_m,
      m.tension_error_mN_per_m, m.effective_modulus_kPa, m.effective_modulus_error_kPa, m.axial_tension_Pa,
      m.axial_tension_error_Pa, m.axial_tension_Pa / s.axial.wall_stress_Pa,
      m.axial_tension_error_Pa / s.axial.wall_stress_Pa,
      m.freedom > 0 ? fmt::format("; chi2 {:.3g}, where {} +- {:.2g} is expected of one image of such a cell",
                                  m.chi_squared, m.freedom, std::sqrt(2.0 * m.freedom))
                    : "");
}

}  // namespace

std::vector<std::string> lines_of(const ModuliSummary& s) {
  std::vector<std::string> lines = law_lines(s.axial);
  if (s.axial.is_of_elongated_cells && s.has_stiffness() && (s.axial.law.is_found || !is_of_minority(s)))
    lines.push_back(fmt::format("effective Young's modulus {} kPa (median; bulk, cortex and tension together)",
                                median_text(s.effective_modulus_kPa)));
  for (const std::string& line : slope_lines(s.axial)) lines.push_back(line);
  if (std::string median = median_line(s); !median.empty()) lines.push_back(std::move(median));
  return lines;
}

}  // namespace rheocyte
