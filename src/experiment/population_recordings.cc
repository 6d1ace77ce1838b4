#include "experiment/population_recordings.h"

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
#include "events/plausibility.h"
#include "experiment/condition_reports.h"
#include "experiment/shared_spreads.h"
#include "experiment/unlike_recordings.h"
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
  r.flow = events.flow();
  r.pixel_size_um = events.pixel_size_um;
  r.medium = events.medium;
  r.temperature_C = events.temperature_C;
  r.median_viscosity_mPas = median_of(events.of(SeenMeasure::viscosity_mPas));
  r.median_elongation = no_value;
  if (events.has_inertia_ratios)
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

std::vector<std::string> PopulationAnalysis::unlike_recordings() const {
  std::vector<RecordingReports> of_condition(conditions_.size());
  for (const RecordingReport& r : recordings_) of_condition[r.condition].push_back(&r);
  std::vector<std::string> warnings;
  for (std::size_t c = 0; c < conditions_.size(); ++c) {
    const std::string &name = conditions_[c].name, &first = conditions_.front().name;
    if (const auto differences = differences_within(of_condition[c]); !differences.empty())
      warnings.push_back(
          fmt::format("the recordings of {} differ in {}; each is read by its own map, but the cells need not be the "
                      "same there. How "
                      "E grows as a power of the stress is told of three flow rates in one channel and one medium.",
                      name, differences));
    if (const auto differences = differences_between(of_condition.front(), of_condition[c]); !differences.empty())
      warnings.push_back(
          fmt::format("{} and {} differ in {}: their ratio is not that of the cells alone.", name, first, differences));
  }
  return warnings;
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
  report.warnings = unlike_recordings();
  if (options_.shared_spread)
    for (auto& remark : share_spreads(conditions_, report.level, report.recordings))
      report.warnings.push_back(std::move(remark));
  report.conditions = condition_reports(report.recordings, conditions_, report.level);
  report.comparisons = comparisons_of(report.recordings, conditions_.size(),
                                      {options_.paired, {report.level, options_.between_recordings}});
  return report;
}

}  // namespace rheocyte
