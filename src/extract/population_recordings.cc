#include "extract/population_recordings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <thread>

#include "case/refuse_path.h"
#include "case/user_error.h"
#include "numeric/quantile.h"

namespace rheocyte {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t fewest_population_events = 20, areas_that_tell = 32;
constexpr std::array measure_words{std::pair(std::string_view("asymmetry"), StiffnessMeasure::asymmetry),
                                   std::pair(std::string_view("odd-deformation"), StiffnessMeasure::odd_deformation),
                                   std::pair(std::string_view("deformation"), StiffnessMeasure::deformation)};

PopulationCondition condition_of(const std::string& text) {
  const auto sign = text.find('=');
  if (sign == std::string::npos || sign == 0 || sign + 1 == text.size())
    throw UserError(fmt::format(
        "rheocyte: --condition {}: give a name and its recordings, for example --condition control=A.rtdc,B.rtdc.",
        one_line(text, 60)));
  PopulationCondition condition{text.substr(0, sign), {}};
  for (std::size_t first = sign + 1; first <= text.size();) {
    const std::size_t last = std::min(text.find(',', first), text.size());
    if (last > first) condition.recordings.emplace_back(text.substr(first, last - first));
    first = last + 1;
  }
  return condition;
}

void check_files(const std::vector<PopulationCondition>& conditions) {
  std::set<fs::path> known;
  for (const auto& condition : conditions)
    for (const auto& file : condition.recordings) {
      std::error_code error;
      const fs::path whole = fs::weakly_canonical(file, error);
      if (!known.insert(error ? file : whole).second)
        refuse_path(file, "is named twice; each recording counts once and belongs to one condition.");
    }
}

void check_pairs(const std::vector<PopulationCondition>& conditions) {
  for (const auto& condition : conditions)
    if (condition.recordings.size() != conditions.front().recordings.size())
      throw UserError(fmt::format(
          "rheocyte: --paired wants equally many recordings of each condition, the first of each being of "
          "one session and so on, but {} has {} and {} has {}.",
          conditions.front().name, conditions.front().recordings.size(), condition.name, condition.recordings.size()));
}

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
      return "the events do not tell all parameters of the population apart: the information is singular; more events "
             "or wider gates help.";
    default:
      return "no population was found that has these events most probably; do the gates leave cells of one kind?";
  }
}

void tell_bounds(RecordingReport& r) {
  constexpr std::array names{"the mean radius", "the mean of ln E", "the spread of the radius", "the spread of E",
                             "the correlation of radius and E"};
  for (std::size_t k = 0; k < names.size(); ++k)
    if (r.fitted.state == FitState::fitted && r.fitted.at_bound[k])
      r.warnings.push_back(fmt::format("{} is at its bound and has no interval.", names[k]));
}

std::vector<std::string> differences_within(const std::vector<RecordingReport>& recordings,
                                            const std::vector<PopulationCondition>& conditions) {
  std::vector<std::string> warnings;
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    std::set<std::array<double, 4>> kinds;
    for (const auto& r : recordings)
      if (r.condition == c) kinds.insert({r.flow.width_um, r.flow.rate_ul_s, r.flow.exponent, r.pixel_size_um});
    if (kinds.size() > 1)
      warnings.push_back(fmt::format(
          "{}: its recordings differ in channel, flow rate, medium or pixels; each is read by a map of its own.",
          conditions[c].name));
  }
  return warnings;
}

/// The means of the recordings of a condition, in the order of the sessions; empty if one has none.
std::vector<RecordingMean> means_of(const std::vector<RecordingReport>& recordings, std::size_t condition) {
  std::vector<RecordingMean> means;
  for (const auto& r : recordings) {
    if (r.condition != condition) continue;
    if (!r.failure.empty()) return {};
    means.push_back(r.mean());
  }
  return means;
}

/// A comparison of the condition with zero has the interval of its mean.
IntervalEstimate mean_of_condition(const std::vector<RecordingMean>& means, double level, bool by_recordings) {
  const std::vector<RecordingMean> zero(means.size(), {0, 0});
  const ConditionDifference d = paired_difference(zero, means, {level, {}});
  if (by_recordings) return {d.value, d.lower, d.upper};
  return {d.value, d.sampling_lower, d.sampling_upper};
}

/// Recordings of one condition at several flow rates tell how E grows with the stress; they scatter about a line then.
void tell_stiffening(const std::vector<RecordingReport>& recordings, std::size_t condition, double level,
                     ConditionReport& report) {
  std::vector<MeanAtStress> means;
  for (const auto& r : recordings)
    if (r.condition == condition) means.push_back({r.mean(), std::log(r.wall_stress_Pa())});
  double log_stress = 0;
  for (const auto& m : means) log_stress += m.log_stress / double(means.size());
  report.wall_stress_Pa = std::exp(log_stress);
  if (!differ_in_stress(means)) return;
  const Stiffening& found = report.stiffening.emplace(stiffening_of(means, level));
  report.between = {};  // they scatter about the line, not about their mean
  report.is_by_recordings = found.has_scatter();
  report.log_modulus = found.has_scatter() ? IntervalEstimate{found.value, found.value_lower, found.value_upper}
                                           : mean_of_condition(means_of(recordings, condition), level, false);
}

ConditionReport condition_report(const std::vector<RecordingReport>& recordings, std::size_t condition,
                                 const std::string& name, double level) {
  ConditionReport report;
  report.name = name;
  std::vector<double> elongations, log_spreads, radii, log_radius_spreads;
  for (const auto& r : recordings) {
    if (r.condition != condition) continue;
    ++report.recordings;
    report.events += r.fitted_events;
    elongations.push_back(r.median_elongation);
    radii.push_back(r.fitted.cells.mean_log_radius);
    log_spreads.push_back(std::log(r.fitted.cells.modulus_spread));
    log_radius_spreads.push_back(std::log(r.fitted.cells.radius_spread));
  }
  report.elongation = median_of(elongations);
  const auto means = means_of(recordings, condition);
  if (means.empty()) return report;
  const auto average = [](const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / double(values.size());
  };
  report.is_by_recordings = means.size() > 1;
  report.log_modulus = mean_of_condition(means, level, report.is_by_recordings);
  report.modulus_spread = std::exp(average(log_spreads));
  report.log_radius = average(radii);
  report.radius_spread = std::exp(average(log_radius_spreads));
  report.between = scatter_between(means, level);
  tell_stiffening(recordings, condition, level, report);
  return report;
}

}  // namespace

std::vector<PopulationCondition> conditions_of(const PopulationOptions& options) {
  std::vector<PopulationCondition> conditions;
  for (const std::string& text : options.conditions) conditions.push_back(condition_of(text));
  check_conditions(conditions, options.paired);
  return conditions;
}

void check_conditions(const std::vector<PopulationCondition>& conditions, bool paired) {
  if (conditions.empty())
    throw UserError(
        "rheocyte: no condition is given; for example --condition control=A.rtdc,B.rtdc --condition "
        "drug=C.rtdc,D.rtdc, or a SPEC.toml with a section [conditions].");
  for (const auto& [name, recordings] : conditions) {
    if (recordings.empty())
      throw UserError(fmt::format("rheocyte: the condition {} has no recordings.", one_line(name, 60)));
    if (std::ranges::count(conditions, name, &PopulationCondition::name) > 1)
      throw UserError(fmt::format("rheocyte: the condition {} is given twice; name all its recordings at once.",
                                  one_line(name, 60)));
  }
  check_files(conditions);
  if (paired) check_pairs(conditions);
}

StiffnessMeasure stiffness_measure_of(const PopulationOptions& options) {
  if (options.by.empty()) return StiffnessMeasure::asymmetry;
  for (const auto& [word, by] : measure_words)
    if (word == options.by) return by;
  throw UserError(fmt::format("rheocyte: --by {}: it must be asymmetry, odd-deformation or deformation.",
                              one_line(options.by, 40)));
}

std::string_view name_of(StiffnessMeasure by) {
  return std::ranges::find(measure_words, by, &decltype(measure_words)::value_type::second)->first;
}

RecordingMean RecordingReport::mean() const {
  constexpr int e = number_of(PopulationParameter::mean_log_modulus);
  return {fitted.cells.mean_log_modulus, fitted.covariance(e, e)};
}

double RecordingReport::wall_stress_Pa() const {
  ChannelFlow at_median = flow;
  at_median.viscosity_mPas = median_viscosity_mPas;
  return wall_shear_stress_Pa(at_median);
}

bool PopulationReport::has_failures() const {
  return std::ranges::any_of(recordings, [](const auto& r) { return !r.failure.empty(); });
}

PopulationAnalysis::PopulationAnalysis(const PopulationOptions& options, std::vector<PopulationCondition> conditions)
    : options_(options),
      conditions_(std::move(conditions)),
      by_(stiffness_measure_of(options)),
      maps_(by_, options.table) {}

void PopulationAnalysis::check_new(const RecordingReport& recording, const PopulationEvents& events) {
  const auto& areas = events.of(SeenMeasure::area_um2);
  std::vector<double> first(areas.begin(), areas.begin() + std::ptrdiff_t(std::min(areas.size(), areas_that_tell)));
  for (std::size_t k = 0; k < recordings_.size(); ++k)
    if (recordings_[k].recorded == events.recorded && first_areas_[k] == first)
      refuse_path(recording.recording, fmt::format("holds the same events as {}; each measurement counts once.",
                                                   recordings_[k].recording.string()));
  first_areas_.push_back(std::move(first));
}

RecordingReport PopulationAnalysis::described(std::size_t condition, std::size_t session,
                                              const PopulationEvents& events) const {
  RecordingReport r;
  r.recording = conditions_[condition].recordings[session];
  r.condition = condition;
  r.session = session;
  r.flow = events.flow;
  r.pixel_size_um = events.pixel_size_um;
  r.median_viscosity_mPas = median_of(events.of(SeenMeasure::viscosity_mPas));
  r.median_elongation = median_of(events.of(events.has_outlines ? SeenMeasure::mode_2 : SeenMeasure::inertia_ratio));
  r.direction = events.direction;
  r.table = maps_.table(events);
  r.table_error = maps_.table_error(events);
  r.gates = events.gates;
  r.recorded = events.recorded, r.gated = events.gated, r.without_numbers = events.without_numbers;
  r.settings = events.settings;
  r.warnings = events.warnings;
  if (!events.gates_beside_the_model.empty())
    r.warnings.push_back(fmt::format("the gates on {} are not part of the model: what they take away may shift E.",
                                     events.gates_beside_the_model));
  return r;
}

const RecordingReport& PopulationAnalysis::add(std::size_t condition, std::size_t session,
                                               const PopulationEvents& events) {
  RecordingReport r = described(condition, session, events);
  if (events.events() == 0)
    refuse_path(r.recording, events.gates.empty() ? "has no event with an outline, a size and a viscosity."
                                                  : "has no event inside the gates (" + events.gates + ").");
  check_new(r, events);
  const PopulationSample made = population_sample(events, maps_, {options_.no_bins});
  r.beside_table = made.beside_table;
  r.fitted_events = std::size_t(std::lround(made.sample.events()));
  r.is_binned = made.is_binned;
  if (r.fitted_events < fewest_population_events)
    refuse_path(r.recording, fmt::format("has {} events that the gates and the table of its cells leave, of {}; a "
                                         "population needs at least {}.",
                                         r.fitted_events, r.recorded, fewest_population_events));
  FitSettings settings;
  settings.threads = int(options_.jobs.value_or(std::thread::hardware_concurrency()));
  settings.with_shrunken = true;
  r.fitted = fit_cells(made.sample, settings);
  if (r.fitted.state == FitState::tail)
    refuse_path(r.recording, fmt::format("the gates leave a tail of its cells, {:.1g} of them; nothing certain can be "
                                         "said of the rest. Widen the gates.",
                                         r.fitted.kept_share));
  r.failure = failure_of(r);
  if (r.failure.empty()) r.images = single_images(made.sample, r.fitted.cells, r.fitted.event_error);
  tell_bounds(r);
  for (const std::size_t i : made.events) r.shrunken_events.push_back(std::size_t(events.number[i]));
  if (r.failure.empty()) r.checks = check_population(events, made, r.fitted, maps_);
  if (made.is_binned) r.fitted.shrunken.clear();  // those of the bins
  return recordings_.emplace_back(std::move(r));
}

PopulationReport PopulationAnalysis::report() const {
  PopulationReport report;
  report.by = by_;
  report.between_recordings = options_.between_recordings;
  report.recordings = recordings_;
  report.warnings = differences_within(recordings_, conditions_);
  for (std::size_t c = 0; c < conditions_.size(); ++c)
    report.conditions.push_back(condition_report(recordings_, c, conditions_[c].name, report.level));
  const ComparisonSettings settings{report.level, options_.between_recordings};
  const auto control = means_of(recordings_, 0);
  for (std::size_t c = 1; c < conditions_.size(); ++c) {
    const auto treated = means_of(recordings_, c);
    if (control.empty() || treated.empty()) continue;
    const auto difference = options_.paired ? paired_difference(control, treated, settings)
                                            : unpaired_difference(control, treated, settings);
    report.comparisons.push_back({0, c, options_.paired, difference});
  }
  return report;
}

}  // namespace rheocyte
