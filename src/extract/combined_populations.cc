#include "extract/combined_populations.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "case/user_error.h"

namespace rheocyte {
namespace {

constexpr int mode_2 = int(ShapeFeature::first_mode), last_fitted_mode = 7;
/// Between nodes of the shipped table (docs/verification.md, sec. 7).
constexpr double error_of_combined_table = 0.01;
/// A share of the cortex nearer to 0 or 1 than so many of its spreads tells no modulus of the smaller part.
constexpr double least_spreads_from_end = 2, most_relative_error = 0.25;

ModuliOptions moduli_options(const PopulationOptions& options) {
  ModuliOptions moduli;
  moduli.table = options.table;
  return moduli;
}

MeasuredCell cell_of(const PopulationEvents& events, std::size_t i) {
  MeasuredCell cell;
  const auto at = [&](SeenMeasure m) { return events.of(m)[i]; };
  cell.shape.setZero();
  cell.shape(int(ShapeFeature::area_um2)) = std::log(at(SeenMeasure::area_um2));
  cell.shape(int(ShapeFeature::deformation)) = at(SeenMeasure::deformation);
  cell.shape(int(ShapeFeature::moment_ratio)) = std::pow(at(SeenMeasure::inertia_ratio), -2);
  for (int k = 0; k < last_fitted_mode - 1; ++k)
    cell.shape(mode_2 + k) = events.seen[std::size_t(int(SeenMeasure::mode_2) + k)][i];
  cell.flow = events.flow;
  cell.flow.viscosity_mPas = at(SeenMeasure::viscosity_mPas);
  return cell;
}

struct QuantityOfLaw {
  PopulationQuantity quantity;
  double CombinedLogs::*log;
};
constexpr std::array quantities_of_law{
    QuantityOfLaw{PopulationQuantity::stiffness, &CombinedLogs::stiffness},
    QuantityOfLaw{PopulationQuantity::young_modulus, &CombinedLogs::young},
    QuantityOfLaw{PopulationQuantity::cortex_modulus, &CombinedLogs::cortex},
    QuantityOfLaw{PopulationQuantity::cortex_tension, &CombinedLogs::tension},
    QuantityOfLaw{PopulationQuantity::axial_tension, &CombinedLogs::axial},
};

QuantityEstimate estimate_of(const CombinedPopulation& found, const QuantityOfLaw& wanted, double wall_stress_Pa) {
  const CombinedVector slopes = slopes_of_mean(found.fit.parameters, wanted.log);
  const double unit = wanted.quantity == PopulationQuantity::axial_tension ? std::log(wall_stress_Pa) : 0;
  return {wanted.quantity,
          {log_means(found.law).*wanted.log + unit, slopes.dot(found.fit.covariance * slopes)},
          log_spreads(found.law).*wanted.log,
          std::sqrt(slopes.dot(found.common_covariance * slopes))};
}

/// Known to better than a quarter: intervals of what is not are skewed (simulated recordings).
bool is_told(const QuantityEstimate& e) {
  return std::isfinite(e.mean.value) && std::hypot(std::sqrt(e.mean.variance), e.common_error) < most_relative_error;
}

/// What the means of the features may miss, beyond two standard errors: a miss of so much moves E and E2D by a tenth.
double most_residual(int feature) {
  switch (feature - mode_2 + min_mode) {
    case 2: return 1e-3;
    case 3: return 5e-4;
    case 5: return 2e-4;
    default: return feature == int(ShapeFeature::area_um2) ? HUGE_VAL : 3e-4;
  }
}

/// Why bulk and cortex are not told apart; empty if they are.
std::string not_told_apart(const CombinedPopulation& found) {
  const double share = found.law.mean(2), spread = found.law.spread(2);
  if (share < least_spreads_from_end * spread) return "the cells have next to no cortex";
  if (1 - share < least_spreads_from_end * spread) return "the cells are next to nothing but cortex";
  for (std::size_t k = 0; k < found.features.size(); ++k) {
    const auto i = Eigen::Index(k);
    const double error = std::sqrt(found.fit.measured.covariance(i, i) / double(found.fit.events));
    if (std::abs(found.residual(i)) > most_residual(found.features[k]) + 2 * error)
      return fmt::format("the mean c{} is {:+.4f} off", found.features[k] - mode_2 + min_mode, found.residual(i));
  }
  return {};
}

void tell(const CombinedPopulation& found, CombinedReport& combined, RecordingReport& r) {
  combined.not_told = not_told_apart(found);
  for (const QuantityOfLaw& wanted : quantities_of_law) {
    const bool is_of_parts =
        wanted.quantity != PopulationQuantity::stiffness && wanted.quantity != PopulationQuantity::axial_tension;
    const QuantityEstimate e = estimate_of(found, wanted, combined.wall_stress_Pa);
    if (is_told(e) && !(is_of_parts && !combined.not_told.empty())) r.quantities.push_back(e);
  }
  if (!combined.not_told.empty())
    r.warnings.push_back(
        fmt::format("bulk and cortex are not told apart, because {}; what is told is E + E2D/r0.", combined.not_told));
  r.log_radius = found.law.mean(0);
  r.radius_spread = found.law.spread(0);
}

/// Also of measures that were not fitted.
std::vector<MeasureCheck> checks_of(const CombinedPopulation& found, const std::vector<MeasuredCell>& cells) {
  std::vector<int> checked{int(ShapeFeature::area_um2), int(ShapeFeature::deformation),
                           int(ShapeFeature::moment_ratio)};
  for (int k = min_mode; k <= last_fitted_mode; ++k) checked.push_back(mode_2 + k - min_mode);
  std::vector<MeasureCheck> checks;
  for (const int feature : checked) {
    const auto shown = [feature](const ShapeVector& shape) {
      return feature == int(ShapeFeature::moment_ratio) ? 1 / std::sqrt(std::max(shape(feature), 0.1)) : shape(feature);
    };
    std::vector<double> measured, predicted;
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (!found.fit.is_stranger[i]) measured.push_back(shown(cells[i].shape));
    for (const ShapeVector& shape : found.drawn) predicted.push_back(shown(shape));
    if (measured.empty() || predicted.empty()) return {};
    const bool is_fitted = std::ranges::find(found.features, feature) != found.features.end();
    std::string name = feature == int(ShapeFeature::area_um2)       ? "ln A"
                       : feature == int(ShapeFeature::deformation)  ? "d"
                       : feature == int(ShapeFeature::moment_ratio) ? "inertia ratio"
                                                                    : fmt::format("c{}", feature - mode_2 + min_mode);
    checks.push_back(compared_measure(std::move(name),
                                      is_fitted ? MeasureRule::fitted_among_others : MeasureRule::not_fitted,
                                      std::move(measured), std::move(predicted)));
  }
  return checks;
}

}  // namespace

CombinedPopulations::CombinedPopulations(const PopulationOptions& options)
    : wanted_section_(options.section),
      table_(moduli_options(options)),
      moduli_(table_.between, table_.simulated, {features_of_contour(last_fitted_mode), true, 0}) {
  if (!options.by.empty() && options.by != "asymmetry")
    throw UserError(
        fmt::format("rheocyte: --by {} and --model cortex contradict each other: bulk and cortex are told by "
                    "the whole outline. Leave --by out.",
                    options.by));
  if (!table_.between.is_elongated() || table_.between.tension_ratios().size() < 2)
    throw UserError(fmt::format(
        "rheocyte: --model cortex needs a combined table of elongated cells (table.axial_ratio) with several tensions "
        "of the cortex (table.tension_ratio), as the program's own; {} is none.",
        table_.content.spec.identifier));
}

double CombinedPopulations::table_error(const PopulationEvents&) { return error_of_combined_table; }

void CombinedPopulations::fit(const PopulationEvents& events, RecordingReport& r) {
  std::vector<MeasuredCell> cells;
  for (std::size_t i = 0; i < events.events(); ++i) cells.push_back(cell_of(events, i));
  r.fitted_events = cells.size();
  check_events_of_population(r);
  if (std::isfinite(events.least_area_um2) || std::isfinite(events.greatest_area_um2))
    r.warnings.emplace_back(
        "limits of the area are no part of the model of cells with a cortex: they should leave the population alone, "
        "or its numbers shift.");
  CombinedReport& combined = r.combined.emplace();
  combined.section = section_seen(wanted_section_, events.made_of, table_.content.spec.base);
  combined.wall_stress_Pa = r.wall_stress_Pa();
  combined.found = fit_combined_population(moduli_, {events.flow, combined.section, table_.section_error_factor()},
                                           events.pixel_size_um, cells, [] {});
  const MomentFit& fit = combined.found.fit;
  if (!fit.is_found) {
    r.failure =
        "no population of cells with bulk, cortex and tensions was found that has these outlines; `rheocyte moduli` "
        "tells how far single events are from the cells of the table.";
    return;
  }
  combined.strangers = cells.size() - fit.events;
  r.fitted_events = fit.events;
  tell(combined.found, combined, r);
  if (r.quantities.empty()) {
    r.failure = "the events do not tell the parameters of the population apart; more events help.";
    return;
  }
  r.checks = checks_of(combined.found, cells);
}

}  // namespace rheocyte
