#include "experiment/combined_populations.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "case/joined.h"
#include "case/to_path.h"
#include "case/user_error.h"
#include "shelf/square_section.h"

namespace rheocyte {
namespace {

constexpr int mode_2 = int(ShapeFeature::first_mode), last_fitted_mode = 7;
/// A fraction of the cortex nearer to 0 or 1 than so many of its spreads gives no modulus of the smaller part.
constexpr double least_spreads_from_end = 2, most_relative_error = 0.25;

ModuliOptions moduli_options(const PopulationOptions& options) {
  ModuliOptions moduli;
  moduli.table = to_path(options.table);
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
  cell.flow = events.flow();
  cell.flow.viscosity_mPas = at(SeenMeasure::viscosity_mPas);
  return cell;
}

struct QuantityOfLaw {
  PopulationQuantity quantity;
  double CombinedLogs::*log;
  bool is_of_parts;  ///< not known if bulk and cortex cannot be separated
};
constexpr std::array quantities_of_law{
    QuantityOfLaw{PopulationQuantity::stiffness, &CombinedLogs::stiffness, false},
    QuantityOfLaw{PopulationQuantity::effective_modulus, &CombinedLogs::effective, false},
    QuantityOfLaw{PopulationQuantity::young_modulus, &CombinedLogs::young, true},
    QuantityOfLaw{PopulationQuantity::cortex_modulus, &CombinedLogs::cortex, true},
    QuantityOfLaw{PopulationQuantity::cortex_tension, &CombinedLogs::tension, true},
    QuantityOfLaw{PopulationQuantity::axial_tension, &CombinedLogs::axial, false},
};

QuantityEstimate estimate_of(const CombinedPopulation& found, const QuantityOfLaw& wanted, double wall_stress_Pa) {
  const NumberOfLaw told = number_of_law(found, wanted.log);
  const double unit = wanted.quantity == PopulationQuantity::axial_tension ? std::log(wall_stress_Pa) : 0;
  return {wanted.quantity, {told.mean + unit, told.variance}, told.spread, told.common_error};
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

/// Why bulk and cortex cannot be separated; empty if they are.
std::string not_told_apart(const CombinedPopulation& found) {
  const double fraction = found.law.mean(2), spread = found.law.spread(2);
  for (const auto& [from_end, end] : {std::pair(fraction, "no cortex"), std::pair(1 - fraction, "cortex alone")})
    if (from_end < least_spreads_from_end * spread)
      return fmt::format(
          "the fraction of the cortex in E + E2D/r0, {:.2f} with a spread of {:.2f}, reaches that of cells of {}",
          fraction, spread, end);
  for (std::size_t k = 0; k < found.features.size(); ++k) {
    const auto i = Eigen::Index(k);
    const double error = std::sqrt(found.fit.measured.covariance(i, i) / double(found.fit.events));
    if (std::abs(found.residual(i)) > most_residual(found.features[k]) + 2 * error)
      return fmt::format("the mean c{} is {:+.4f} off", found.features[k] - mode_2 + min_mode, found.residual(i));
  }
  return {};
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "" : k + 1 == words.size() ? " and " : ", ") + words[k];
  return text;
}

std::string_view are(const std::vector<std::string>& words) { return words.size() > 1 ? "are" : "is"; }

void tell(const CombinedPopulation& found, CombinedReport& combined, RecordingReport& r) {
  combined.not_told = not_told_apart(found);
  std::vector<std::string> told, unknown;
  bool more_events_help = false;
  for (const QuantityOfLaw& wanted : quantities_of_law) {
    if (wanted.is_of_parts && !combined.not_told.empty()) continue;
    const QuantityEstimate e = estimate_of(found, wanted, combined.wall_stress_Pa);
    const std::string symbol(words_of(wanted.quantity).symbol);
    (is_told(e) ? told : unknown).push_back(symbol);
    if (is_told(e)) r.quantities.push_back(e);
    more_events_help |= !is_told(e) && std::sqrt(e.mean.variance) > e.common_error;
  }
  if (!combined.not_told.empty())
    r.warnings.push_back(fmt::format("bulk and cortex are not determined separately, because {}; known: {}.",
                                     combined.not_told, told.empty() ? "nothing" : listed(told)));
  if (!unknown.empty())
    r.warnings.push_back(fmt::format("{} {} not given: known to no better than {:.0f} %{}", listed(unknown),
                                     are(unknown), 100 * most_relative_error,
                                     more_events_help ? "; more events help." : " by the table."));
  r.log_radius = found.law.mean(0);
  r.radius_spread = found.law.spread(0);
}

/// A spread at its lower bound is none that could be seen.
void tell_bounds(const MomentFit& fit, RecordingReport& r) {
  using enum CombinedParameter;
  constexpr std::array names{std::pair(cortex_fraction, "the fraction of the cortex"),
                             std::pair(tension_ratio, "the tension of the cortex over E2D"),
                             std::pair(log_fraction_spread, "the spread of the fraction of the cortex"),
                             std::pair(log_ratio_spread, "the spread of the tension of the cortex over E2D"),
                             std::pair(log_axial_spread, "the spread of the axial tension")};
  const double small_spread = std::log(0.05);
  std::vector<std::string> means, spreads;
  for (const auto& [parameter, name] : names) {
    const bool is_spread = parameter >= log_radius_spread;
    if (fit.at_bound[std::size_t(parameter)] && !(is_spread && fit.parameters(int(parameter)) < small_spread))
      (is_spread ? spreads : means).emplace_back(name);
  }
  if (!means.empty())
    r.warnings.push_back(
        fmt::format("{} {} at the end of the table, and cells beyond it may fit better; the intervals allow for them.",
                    listed(means), are(means)));
  if (!spreads.empty())
    r.warnings.push_back(fmt::format("{} {} at the bound of the search; the intervals take {} as known.",
                                     listed(spreads), are(spreads), spreads.size() > 1 ? "them" : "it"));
}

/// On which side of a range of the table the mean cell lies: -1, 0, 1.
int beyond(const CombinedPopulation& found, const CellBox& box, int c) {
  return found.mean_cell(c) > box.greatest(c) ? 1 : found.mean_cell(c) < box.least(c) ? -1 : 0;
}

/// Of cells of other sizes than those of the table; else empty.
std::string why_not_in_table(const CombinedPopulation& found, const CombinedInterpolation& table, double length_scale) {
  const int by_size = beyond(found, table.box(), x_radius);
  if (by_size == 0) return {};
  return fmt::format(
      "its cells, of {:.3g} um, are {} than those of the table, which has {:.3g} to {:.3g} um in this channel.",
      std::exp(found.law.mean(0)), by_size > 0 ? "larger" : "smaller", length_scale * table.radii_um().front(),
      length_scale * table.radii_um().back());
}

/// Of a stiff cell hardly anything is seen.
void tell_stiff(const CombinedPopulation& found, const CellBox& box, RecordingReport& r) {
  if (beyond(found, box, x_progress) < 0)
    r.warnings.emplace_back("the mean cell is stiffer than those of the table, which is continued to it.");
}

/// Beyond the soft end the shapes of the table go straight on: the cells there are fitted with the others.
void count_beyond(const CombinedPopulation& found, RecordingReport& r) {
  r.beyond = events_beyond(found);
  r.continued_events = r.beyond.on(TableSide::softer) + r.beyond.on(TableSide::longer);
}

/// Also of measures that were not fitted.
std::vector<MeasureCheck> checks_of(const CombinedPopulation& found, const std::vector<MeasuredCell>& cells,
                                    double pixel_size_um) {
  std::vector<int> checked{int(ShapeFeature::area_um2), int(ShapeFeature::deformation),
                           int(ShapeFeature::moment_ratio)};
  for (int k = min_mode; k <= last_fitted_mode; ++k) checked.push_back(mode_2 + k - min_mode);
  std::vector<MeasureCheck> checks;
  for (const int feature : checked) {
    const auto shown = [feature](const ShapeVector& shape) {
      return feature == int(ShapeFeature::moment_ratio) ? 1 / std::sqrt(std::max(shape(feature), 0.1)) : shape(feature);
    };
    CheckedValues measured, predicted;
    const auto add = [&](CheckedValues& to, const ShapeVector& shape) {
      to.values.push_back(shown(shape));
      to.log_area.push_back(shape(int(ShapeFeature::area_um2)));
    };
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (found.counts[i]) add(measured, cells[i].shape);
    for (const ShapeVector& shape : found.drawn) add(predicted, shape);
    if (measured.values.empty() || predicted.values.empty()) return {};
    const bool is_fitted = std::ranges::find(found.features, feature) != found.features.end();
    std::string name = feature == int(ShapeFeature::area_um2)       ? "ln A"
                       : feature == int(ShapeFeature::deformation)  ? "d"
                       : feature == int(ShapeFeature::moment_ratio) ? "inertia ratio"
                                                                    : fmt::format("c{}", feature - mode_2 + min_mode);
    const double convention = mask_convention(name, pixel_size_um, measured.log_area);
    checks.push_back(compared_measure(std::move(name),
                                      is_fitted ? MeasureRule::fitted_among_others : MeasureRule::not_fitted, measured,
                                      predicted, convention));
  }
  return checks;
}

}  // namespace

CombinedPopulations::CombinedPopulations(const PopulationOptions& options)
    : wanted_section_(options.section),
      outline_noise_um_(options.outline_noise_um.value_or(0)),
      tables_(moduli_options(options)) {
  if (!options.by.empty() && options.by != "asymmetry")
    throw UserError(
        fmt::format("rheocyte: --by {} and --model cortex contradict each other: bulk and cortex follow from "
                    "the whole outline. Leave --by out.",
                    options.by));
  const CombinedInterpolation& table = tables_.computed().between;
  if (!table.is_elongated() || table.tension_ratios().size() < 2)
    throw UserError(fmt::format(
        "rheocyte: --model cortex needs a combined table of elongated cells (table.axial_ratio) with several tensions "
        "of the cortex (table.tension_ratio), as the program's own; {} is none.",
        table.spec().identifier));
}

std::string CombinedPopulations::systematic_errors(std::span<const RecordingReport> recordings) const {
  std::vector<std::string> errors;
  for (const QuantityOfLaw& wanted : quantities_of_law) {
    double greatest = 0;
    for (const RecordingReport& r : recordings)
      if (const QuantityEstimate* e = r.estimate(wanted.quantity)) greatest = std::max(greatest, e->common_error);
    if (greatest > 0) errors.push_back(fmt::format("{:.2g} % of {}", 100 * greatest, words_of(wanted.quantity).symbol));
  }
  return "table, section and their remaining errors " +
         (errors.empty() ? "as docs/verification.md has them" : joined(errors, ", ")) +
         "; pixels below the intervals; viscosity model as docs/verification.md has it";
}

void CombinedPopulations::fit(const PopulationEvents& events, RecordingReport& r, const Watch& watch) {
  std::vector<MeasuredCell> cells;
  for (std::size_t i = 0; i < events.events(); ++i) cells.push_back(cell_of(events, i));
  r.fitted_events = cells.size();
  check_events_of_population(r);
  CombinedReport& combined = r.combined.emplace();
  combined.section = section_seen(wanted_section_, events.made_of, tables_.computed().content.spec.base);
  const ModuliTable& table = tables_.seen_in(combined.section, events.flow().exponent, events.made_of);
  const BulkCortexFit moduli(table.between, table.simulated, {features_of_contour(last_fitted_mode), true, 0});
  combined.wall_stress_Pa = r.wall_stress_Pa();
  const SeenPopulation seen{.sight = {events.flow(), combined.section, table.section_error_factor()},
                            .pixel_size_um = events.pixel_size_um,
                            .log_area = log_area_gate(events.least_area_um2, events.greatest_area_um2),
                            .outline_noise = {.deviation = outline_noise_um_}};
  combined.found = fit_combined_population(moduli, seen, cells, watch);
  const MomentFit& fit = combined.found.fit;
  if (!fit.is_found) {
    r.failure =
        "no population of cells with bulk, cortex and tensions was found that has these outlines; `rheocyte moduli` "
        "reports how far single events are from the cells of the table.";
    return;
  }
  combined.strangers = cells.size() - combined.found.smaller - combined.found.larger - fit.events;
  r.fitted_events = fit.events;
  count_beyond(combined.found, r);
  if (combined.found.kept_fraction < least_kept_fraction) refuse_tail(r, combined.found.kept_fraction);
  r.failure = why_not_in_table(combined.found, moduli.table(), scale_factors(moduli.simulated(), events.flow()).length);
  if (!r.failure.empty()) return;
  const CellsBeyond& beyond = combined.found.beyond;
  refuse_most_beyond(PopulationQuantity::stiffness, bound_of_median(beyond.log_stiffness_of_last, beyond.all), r);
  if (r.is_beyond) return;
  tell(combined.found, combined, r);
  tell_bounds(fit, r);
  tell_beyond(r);
  tell_stiff(combined.found, moduli.table().box(), r);
  if (r.quantities.empty()) {
    r.failure = "the events do not determine all parameters of the population; more events help.";
    return;
  }
  r.checks = checks_of(combined.found, cells, events.pixel_size_um);
}

}  // namespace rheocyte
