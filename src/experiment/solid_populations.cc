#include "experiment/solid_populations.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "experiment/population_recordings.h"
#include "store/thread.h"

namespace rheocyte {
namespace {

std::string too_stiff_text(const RecordingReport& r) {
  if (!r.fitted.least_log_modulus)
    return "the cells are too stiff to be seen: their asymmetry is below its noise, and no limit can be given.";
  return fmt::format(
      "the cells are too stiff to be seen: their median asymmetry is below its noise; E is above {:.3g} kPa (95 %). A "
      "narrower channel, more flow or a more viscous medium shows them; `rheocyte plan` says which.",
      std::exp(*r.fitted.least_log_modulus));
}

/// Of what is no user's mistake; empty if there are numbers.
std::string failure_of(const RecordingReport& r) {
  switch (r.fitted.state) {
    case FitState::fitted: return {};
    case FitState::too_stiff: return too_stiff_text(r);
    case FitState::singular:
      return "the events do not determine all parameters of the population: the information is singular; more events "
             "or wider gates help.";
    default:
      return "no most probable population was found: the measure of these events is near the noise of the pixels, or "
             "the gates leave cells of one kind.";
  }
}

void tell_bounds(RecordingReport& r) {
  constexpr std::array names{"the mean radius", "the mean of ln E", "the spread of the radius", "the spread of E",
                             "the correlation of radius and E"};
  for (std::size_t k = 0; k < names.size(); ++k)
    if (r.fitted.state == FitState::fitted && r.fitted.at_bound[k])
      r.warnings.push_back(fmt::format("{} is at its bound and has no interval.", names[k]));
}

}  // namespace

void tell_quantities(RecordingReport& r) {
  constexpr int e = number_of(PopulationParameter::mean_log_modulus);
  const CellDistribution& cells = r.fitted.cells;
  r.quantities = {{.quantity = PopulationQuantity::young_modulus,
                   .mean = {cells.mean_log_modulus, r.fitted.covariance(e, e)},
                   .spread = cells.modulus_spread,
                   .log_interval = r.fitted.intervals[std::size_t(e)]}};
  r.log_radius = cells.mean_log_radius;
  r.radius_spread = cells.radius_spread;
}

SolidPopulations::SolidPopulations(const PopulationOptions& options)
    : maps_(stiffness_measure_of(options), options.table, options.outline_noise_um.value_or(0)),
      no_bins_(options.no_bins),
      threads_(int(options.jobs.value_or(processors()))) {}

std::string SolidPopulations::systematic_errors(std::span<const RecordingReport>) const {
  return fmt::format(
      "{} law of the pixels 1 %, table {:.1g} %, viscosity model and section as docs/verification.md has them",
      maps_.by() == StiffnessMeasure::asymmetry ? "c3" : "deformation", 100 * table_error_);
}

void SolidPopulations::fit(const PopulationEvents& events, RecordingReport& r, const Watch&) {
  table_error_ = std::max(table_error_, maps_.table_error(events));
  const PopulationSample made = population_sample(events, maps_, {no_bins_});
  r.beyond = made.beyond;
  r.fitted_events = std::size_t(std::lround(made.sample.events()));
  r.is_binned = made.is_binned;
  refuse_most_beyond(PopulationQuantity::young_modulus, bound_of_median(made.softer_than, r.seen_events()), r);
  if (r.is_beyond) return;
  check_events_of_population(r);
  FitSettings settings;
  settings.threads = threads_;
  settings.with_shrunken = true;
  r.fitted = fit_cells(made.sample, settings);
  if (r.fitted.state == FitState::tail) refuse_tail(r, r.fitted.kept_fraction);
  r.failure = failure_of(r);
  r.is_beyond = r.fitted.state == FitState::too_stiff;
  tell_bounds(r);
  tell_beyond(r);
  for (const std::size_t i : made.events) r.shrunken_events.push_back(std::size_t(events.number[i]));
  if (r.failure.empty()) {
    tell_quantities(r);
    r.images = single_images(made.sample, r.fitted.cells, r.fitted.event_error);
    r.checks = check_population(events, made, r.fitted, maps_);
  }
  if (made.is_binned) r.fitted.shrunken.clear();  // those of the bins
}

}  // namespace rheocyte
