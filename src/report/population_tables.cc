#include "report/population_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rheocyte {
namespace {

std::string table_of_solids(const PopulationReport& report) {
  std::string text(mark_of_population_table);
  text +=
      "events\tyoung_modulus_kPa\tlower_kPa\tupper_kPa\tln_modulus\tln_modulus_error\tln_modulus_spread\tradius_um\t"
      "ln_radius_spread\tcorrelation\telongation\twall_stress_Pa\tkept_fraction\tfits\n";
  for (const auto& r : report.recordings) {
    text += fmt::format("{}\t{}\t{}\t{}\t", report.conditions[r.condition].name, r.session + 1, r.recording.string(),
                        r.fitted_events);
    if (!r.failure.empty()) {
      constexpr int numbers = 12;
      for (int k = 0; k < numbers; ++k) text += "nan\t";
      text += "no\n";
      continue;
    }
    const CellDistribution& c = r.fitted.cells;
    const auto& e = r.fitted.intervals[std::size_t(number_of(PopulationParameter::mean_log_modulus))];
    text += fmt::format(
        "{:.6g}\t{:.6g}\t{:.6g}\t{:.6g}\t{:.4g}\t{:.6g}\t{:.6g}\t{:.6g}\t{:.4g}\t{:.4g}\t{:.4g}\t{:.4g}\t{}\n",
        std::exp(c.mean_log_modulus), std::exp(e.lower), std::exp(e.upper), c.mean_log_modulus,
        r.fitted.standard_error(PopulationParameter::mean_log_modulus), c.modulus_spread, std::exp(c.mean_log_radius),
        c.radius_spread, c.correlation, r.median_elongation, r.wall_stress_Pa(), r.fitted.kept_fraction,
        std::ranges::all_of(r.checks, &MeasureCheck::fits) ? "yes" : "no");
  }
  return text;
}

/// The quantities one beside the other; nan where a recording does not tell one.
std::string table_of_combined(const PopulationReport& report) {
  std::string text(mark_of_population_table);
  text += "events\tradius_um\tln_radius_spread\telongation\twall_stress_Pa\tkept_fraction";
  const auto quantities = report.quantities();
  for (const auto quantity : quantities) {
    const auto key = words_of(quantity).key;
    text += fmt::format("\t{0}\t{0}_ln_error\t{0}_ln_spread", key);
  }
  text += "\tfits\n";
  for (const auto& r : report.recordings) {
    text +=
        fmt::format("{}\t{}\t{}\t{}\t{:.6g}\t{:.4g}\t{:.4g}\t{:.4g}\t{:.4g}", report.conditions[r.condition].name,
                    r.session + 1, r.recording.string(), r.fitted_events, std::exp(r.log_radius), r.radius_spread,
                    r.median_elongation, r.wall_stress_Pa(), r.combined ? r.combined->found.kept_fraction : no_value);
    for (const auto quantity : quantities) {
      const QuantityEstimate* const e = r.estimate(quantity);
      text +=
          e ? fmt::format("\t{:.6g}\t{:.4g}\t{:.4g}", std::exp(e->mean.value), std::sqrt(e->mean.variance), e->spread)
            : "\tnan\tnan\tnan";
    }
    const bool fits = r.failure.empty() && std::ranges::all_of(r.checks, &MeasureCheck::fits);
    text += fits ? "\tyes\n" : "\tno\n";
  }
  return text;
}

}  // namespace

std::string population_table(const PopulationReport& report) {
  return report.model == "solid" ? table_of_solids(report) : table_of_combined(report);
}

std::string population_events_table(const RecordingReport& recording) {
  const auto& cells = recording.fitted.shrunken;
  if (cells.empty()) return {};
  std::vector<std::size_t> order(cells.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::ranges::sort(order, {}, [&](std::size_t k) { return recording.shrunken_events[k]; });
  std::string text(mark_of_population_events);
  text += "radius_um\tln_radius_sd\n";
  for (const std::size_t k : order)
    text += fmt::format("{}\t{:.5g}\t{:.3g}\t{:.5g}\t{:.3g}\n", recording.shrunken_events[k],
                        std::exp(cells[k].log_modulus), cells[k].modulus_deviation, std::exp(cells[k].log_radius),
                        cells[k].radius_deviation);
  return text;
}

}  // namespace rheocyte
