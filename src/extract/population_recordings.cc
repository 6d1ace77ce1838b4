#include "extract/population_recordings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "case/refuse_path.h"
#include "case/split.h"
#include "case/to_path.h"
#include "case/user_error.h"
#include "extract/plausibility.h"
#include "extract/shared_spreads.h"
#include "numeric/quantile.h"

namespace rheocyte {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t areas_that_tell = 32;
constexpr std::array measure_words{std::pair(std::string_view("asymmetry"), StiffnessMeasure::asymmetry),
                                   std::pair(std::string_view("odd-deformation"), StiffnessMeasure::odd_deformation),
                                   std::pair(std::string_view("deformation"), StiffnessMeasure::deformation)};

/// The name that begins with this part; then it is the next one's turn. A name with commas is one where there is such a
/// file.
std::string next_name(const std::vector<std::string>& parts, std::size_t& part) {
  std::string name;
  for (std::size_t end = part; end < parts.size(); ++end) {
    std::error_code error;
    name += (end > part ? "," : "") + parts[end];
    if (!fs::is_regular_file(to_path(name), error)) continue;
    part = end + 1;
    return name;
  }
  return parts[part++];
}

PopulationCondition condition_of(const std::string& text) {
  const auto sign = text.find('=');
  const auto refuse = [&text](const char* how) {
    throw UserError(fmt::format("rheocyte: --condition {}: {}", one_line(text, 60), how));
  };
  if (sign == std::string::npos || sign == 0 || sign + 1 == text.size())
    refuse("give a name and its recordings, for example --condition control=A.rtdc,B.rtdc.");
  PopulationCondition condition{text.substr(0, sign), {}};
  const std::vector<std::string> parts = split(std::string_view(text).substr(sign + 1), ',');
  for (std::size_t part = 0; part < parts.size();) {
    const std::string name = next_name(parts, part);
    if (name.empty()) refuse("the name of a recording is empty.");
    condition.recordings.push_back(to_path(name));
  }
  return condition;
}

/// It is a part of the names of files, and a word of tables.
void check_name(const std::string& name) {
  constexpr std::size_t longest = 100;
  const bool is_word =
      std::ranges::none_of(name, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '/' || c == '\\'; });
  if (!is_word || name.size() > longest)
    throw UserError(
        fmt::format("rheocyte: the condition {}: a name has no more than {} characters, and neither slashes "
                    "nor line breaks or tabs.",
                    one_line(name, 60), longest));
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

std::vector<std::string> differences_within(const std::vector<RecordingReport>& recordings,
                                            const std::vector<PopulationCondition>& conditions) {
  std::vector<std::string> warnings;
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    std::set<std::array<double, 4>> kinds;
    for (const auto& r : recordings)
      // An exponent to as many digits as the temperatures of recordings of one medium leave.
      if (r.condition == c)
        kinds.insert({r.flow.width_um, r.flow.rate_ul_s, std::round(100 * r.flow.exponent), r.pixel_size_um});
    if (kinds.size() > 1)
      warnings.push_back(fmt::format(
          "{}: its recordings differ in channel, flow rate, medium or pixels; each is read by a map of its own.",
          conditions[c].name));
  }
  return warnings;
}

/// A quantity in the recordings of a condition, in the order of the sessions; empty if one does not tell it.
std::vector<QuantityEstimate> estimates_of(const std::vector<RecordingReport>& recordings, std::size_t condition,
                                           PopulationQuantity quantity) {
  std::vector<QuantityEstimate> estimates;
  for (const auto& r : recordings) {
    if (r.condition != condition) continue;
    const QuantityEstimate* const estimate = r.estimate(quantity);
    if (!estimate) return {};
    estimates.push_back(*estimate);
  }
  return estimates;
}

std::vector<RecordingMean> means_of(const std::vector<QuantityEstimate>& estimates) {
  std::vector<RecordingMean> means;
  for (const auto& e : estimates) means.push_back(e.mean);
  return means;
}

/// Of any recording, in the order in which a model tells them.
std::vector<PopulationQuantity> quantities_told(const std::vector<RecordingReport>& recordings) {
  std::vector<PopulationQuantity> told;
  for (const auto& r : recordings)
    for (const auto& e : r.quantities)
      if (std::ranges::find(told, e.quantity) == told.end()) told.push_back(e.quantity);
  return told;
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

/// A comparison of the condition with zero has the interval of its mean.
IntervalEstimate mean_of_condition(const std::vector<RecordingMean>& means, double level, bool by_recordings) {
  const std::vector<RecordingMean> zero(means.size(), {0, 0});
  const ConditionDifference d = paired_difference(zero, means, {level, {}});
  if (by_recordings) return {d.value, d.lower, d.upper};
  return {d.value, d.sampling_lower, d.sampling_upper};
}

/// Of the recordings of a condition.
struct StressesOfCondition {
  std::vector<double> log_stress;
  double mean = 0;
};

StressesOfCondition stresses_of(const std::vector<RecordingReport>& recordings, std::size_t condition) {
  StressesOfCondition stresses;
  for (const auto& r : recordings)
    if (r.condition == condition) stresses.log_stress.push_back(std::log(r.wall_stress_Pa()));
  stresses.mean = mean_of(stresses.log_stress);
  return stresses;
}

/// Recordings of one condition at several flow rates tell how a modulus grows with the stress; they scatter about a
/// line then.
void tell_stiffening(const std::vector<RecordingMean>& means, const StressesOfCondition& stresses, double level,
                     ConditionQuantity& told) {
  std::vector<MeanAtStress> at_stress;
  for (std::size_t j = 0; j < means.size(); ++j) at_stress.push_back({means[j], stresses.log_stress[j]});
  if (!differ_in_stress(at_stress)) return;
  const Stiffening& found = told.stiffening.emplace(stiffening_of(at_stress, level));
  told.between = {};  // they scatter about the line, not about their mean
  told.is_by_recordings = found.has_scatter();
  told.log_mean = found.has_scatter() ? IntervalEstimate{found.value, found.value_lower, found.value_upper}
                                      : mean_of_condition(means, level, false);
}

ConditionQuantity condition_quantity(PopulationQuantity quantity, const std::vector<QuantityEstimate>& estimates,
                                     const StressesOfCondition& stresses, double level) {
  const auto means = means_of(estimates);
  std::vector<double> log_spreads;
  for (const auto& e : estimates) log_spreads.push_back(std::log(e.spread));
  ConditionQuantity told;
  told.quantity = quantity;
  told.is_by_recordings = means.size() > 1;
  told.log_mean = mean_of_condition(means, level, told.is_by_recordings);
  told.spread = std::exp(mean_of(log_spreads));
  told.between = scatter_between(means, level);
  tell_stiffening(means, stresses, level, told);
  return told;
}

ConditionReport condition_report(const std::vector<RecordingReport>& recordings, std::size_t condition,
                                 const std::string& name, double level) {
  ConditionReport report;
  report.name = name;
  std::vector<double> elongations, radii, log_radius_spreads;
  for (const auto& r : recordings) {
    if (r.condition != condition) continue;
    ++report.recordings;
    report.events += r.fitted_events;
    elongations.push_back(r.median_elongation);
    radii.push_back(r.log_radius);
    log_radius_spreads.push_back(std::log(r.radius_spread));
  }
  report.elongation = mean_of(elongations);
  const StressesOfCondition stresses = stresses_of(recordings, condition);
  for (const PopulationQuantity quantity : quantities_told(recordings))
    if (const auto estimates = estimates_of(recordings, condition, quantity); !estimates.empty())
      report.quantities.push_back(condition_quantity(quantity, estimates, stresses, level));
  if (!report.has_numbers()) return report;
  report.log_radius = mean_of(radii);
  report.radius_spread = std::exp(mean_of(log_radius_spreads));
  report.wall_stress_Pa = std::exp(stresses.mean);
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
    check_name(name);
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

bool PopulationReport::has_failures() const {
  return std::ranges::any_of(recordings, [](const auto& r) { return !r.failure.empty(); });
}

std::vector<PopulationQuantity> PopulationReport::quantities() const { return quantities_told(recordings); }

PopulationAnalysis::PopulationAnalysis(const PopulationOptions& options, std::vector<PopulationCondition> conditions)
    : options_(options),
      conditions_(std::move(conditions)),
      by_(stiffness_measure_of(options)),
      model_(population_model(options)) {}

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
  r.table = model_->table(events);
  r.gates = events.gates;
  r.recorded = events.recorded, r.gated = events.gated, r.without_numbers = events.without_numbers;
  r.settings = events.settings;
  r.warnings = events.warnings;
  if (!events.gates_beside_the_model.empty() && events.gated > 0)
    r.warnings.push_back(fmt::format("the gates on {} are not part of the model: what they take away may shift E.",
                                     events.gates_beside_the_model));
  return r;
}

const RecordingReport& PopulationAnalysis::add(std::size_t condition, std::size_t session,
                                               const PopulationEvents& events, const std::function<void()>& goes_on) {
  RecordingReport r = described(condition, session, events);
  if (events.events() == 0)
    refuse_path(r.recording, events.gates.empty() ? "has no event with an outline, a size and a viscosity."
                                                  : "has no event inside the gates (" + events.gates + ").");
  check_new(r, events);
  check_outline_noise(r.recording, options_.outline_noise_um.value_or(0), events.pixel_size_um,
                      {events.median_shape(), events.of(SeenMeasure::mode_7)});
  model_->fit(events, r, goes_on);
  return recordings_.emplace_back(std::move(r));
}

PopulationReport PopulationAnalysis::report() const {
  PopulationReport report;
  report.model = model_->name();
  report.elongation = model_->elongation_text();
  report.by = by_;
  report.between_recordings = options_.between_recordings;
  report.outline_noise_um = options_.outline_noise_um.value_or(0);
  report.recordings = recordings_;
  report.systematic_errors = model_->systematic_errors(recordings_);
  report.warnings = differences_within(recordings_, conditions_);
  if (options_.shared_spread)
    for (auto& remark : share_spreads(conditions_, report.level, report.recordings))
      report.warnings.push_back(std::move(remark));
  for (std::size_t c = 0; c < conditions_.size(); ++c)
    report.conditions.push_back(condition_report(report.recordings, c, conditions_[c].name, report.level));
  const ComparisonSettings settings{report.level, options_.between_recordings};
  for (std::size_t c = 1; c < conditions_.size(); ++c)
    for (const PopulationQuantity quantity : report.quantities()) {
      const auto control = means_of(estimates_of(report.recordings, 0, quantity)),
                 treated = means_of(estimates_of(report.recordings, c, quantity));
      if (control.empty() || treated.empty()) continue;
      const auto difference = options_.paired ? paired_difference(control, treated, settings)
                                              : unpaired_difference(control, treated, settings);
      report.comparisons.push_back({0, c, quantity, options_.paired, difference});
    }
  return report;
}

}  // namespace rheocyte
