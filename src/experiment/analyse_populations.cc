#include "experiment/analyse_populations.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "case/refuse_path.h"
#include "events/isolated_reading.h"
#include "events/plausibility.h"
#include "events/settings_hash.h"
#include "experiment/condition_reports.h"
#include "experiment/dose_reports.h"
#include "experiment/model_of_shapes.h"
#include "experiment/population_model.h"
#include "experiment/shared_spreads.h"
#include "experiment/tension_of_setup.h"
#include "experiment/unlike_recordings.h"
#include "numeric/quantile.h"

namespace rheocyte {
namespace {

constexpr std::size_t areas_that_tell = 32;

/// Takes the recordings one after the other, in the order of the conditions.
class PopulationAnalysis {
 public:
  PopulationAnalysis(const PopulationOptions& options, const std::vector<PopulationCondition>& conditions,
                     std::string why_this_model);

  /// One of the recordings, with what is known of its shapes.
  struct Place {
    std::size_t condition, session;
    const std::optional<ShapeVerdict>& shapes;
  };
  void add(const Place& place, const PopulationEvents& events, const Watch& watch);
  /// Whether the recording that was added last must be compared with its events without gates on the shape.
  bool needs_all_shapes() const { return model_->lacks_shape_gates() && gates_limit_shapes_; }
  void compare(const PopulationEvents& without_shape_gates) {
    model_->compare(without_shape_gates, recordings_.back());
  }
  /// Of all that were added.
  PopulationReport report();

 private:
  /// In what recordings differ that belong together.
  std::vector<std::string> unlike_recordings() const;
  std::string hash_of_settings(const std::string& table, const PopulationEvents& events) const;
  RecordingReport described(const Place& place, const PopulationEvents& events) const;
  void check_new(const RecordingReport& recording, const PopulationEvents& events);

  const PopulationOptions& options_;
  const std::vector<PopulationCondition>& conditions_;
  std::vector<double> doses_;
  StiffnessMeasure by_;
  bool gates_limit_shapes_;
  std::unique_ptr<PopulationModel> model_;
  std::string why_this_model_;
  std::vector<RecordingReport> recordings_;
  std::vector<std::vector<double>> first_areas_;  ///< of each recording: by these the same measurement is known again
};

PopulationAnalysis::PopulationAnalysis(const PopulationOptions& options,
                                       const std::vector<PopulationCondition>& conditions, std::string why_this_model)
    : options_(options),
      conditions_(conditions),
      doses_(doses_of(options.doses, conditions)),
      by_(stiffness_measure_of(options)),
      gates_limit_shapes_(Gates(options.measuring.gates).limit_shapes()),
      model_(population_model(options)),
      why_this_model_(std::move(why_this_model)) {}

void PopulationAnalysis::check_new(const RecordingReport& recording, const PopulationEvents& events) {
  const auto& areas = events.of(SeenMeasure::area_um2);
  std::vector<double> first(areas.begin(), areas.begin() + std::ptrdiff_t(std::min(areas.size(), areas_that_tell)));
  for (std::size_t k = 0; k < recordings_.size(); ++k)
    if (recordings_[k].recorded == events.recorded && first_areas_[k] == first)
      refuse_path(recording.recording, fmt::format("contains the same events as {}; each measurement counts once.",
                                                   recordings_[k].recording.string()));
  first_areas_.push_back(std::move(first));
}

std::string PopulationAnalysis::hash_of_settings(const std::string& table, const PopulationEvents& events) const {
  std::vector<std::string> lines = events.decisive;
  lines.push_back("table: " + table);
  lines.push_back(fmt::format("population of cells: {}, by {}, outline noise {} um{}{}", model_->name(), name_of(by_),
                              options_.outline_noise_um.value_or(0), options_.no_bins ? ", without bins" : "",
                              options_.shared_spread ? ", one spread for each condition" : ""));
  if (options_.axial_tension_Pa) lines.push_back(fmt::format("axial tension: {} Pa", *options_.axial_tension_Pa));
  return settings_hash(lines);
}

RecordingReport PopulationAnalysis::described(const Place& place, const PopulationEvents& events) const {
  RecordingReport r;
  static_cast<RecordingFacts&>(r) = events;
  r.recording = conditions_[place.condition].recordings[place.session];
  r.condition = place.condition;
  r.session = place.session;
  for (std::size_t m = 0; m < events.seen.size(); ++m)
    if (events.has(SeenMeasure(m))) r.observed[m] = median_with_error(events.seen[m]);
  if (place.shapes) {
    r.by_deformation_kPa = place.shapes->by_deformation.median_kPa;
    r.elongated_kPa = place.shapes->by_elongation.median_kPa;
  }
  r.median_viscosity_mPas = median_of(events.of(SeenMeasure::viscosity_mPas));
  r.median_elongation = no_value;
  if (events.has_inertia_ratios)
    r.median_elongation = median_of(events.of(events.has_outlines ? SeenMeasure::mode_2 : SeenMeasure::inertia_ratio));
  r.table = model_->table(events);
  r.without_numbers = events.without_numbers;
  r.settings_hash = hash_of_settings(r.table, events);
  r.warnings = events.warnings;
  if (!events.gates_beside_the_model.empty() && events.gated > 0 && !needs_all_shapes())
    r.warnings.push_back(
        fmt::format("the gates on {} are not part of the model: what they exclude may change the modulus.",
                    events.gates_beside_the_model));
  return r;
}

void PopulationAnalysis::add(const Place& place, const PopulationEvents& events, const Watch& watch) {
  RecordingReport r = described(place, events);
  if (events.events() == 0)
    refuse_path(r.recording, events.gates.empty() ? "has no event with an outline, a size and a viscosity."
                                                  : "has no event inside the gates (" + events.gates + ").");
  check_new(r, events);
  check_outline_noise(r.recording, options_.outline_noise_um.value_or(0), events.pixel_size_um,
                      {events.median_shape(), events.of(SeenMeasure::mode_7)});
  model_->fit(events, r, watch);
  recordings_.push_back(std::move(r));
}

std::vector<std::string> PopulationAnalysis::unlike_recordings() const {
  std::vector<RecordingReports> of_condition(conditions_.size());
  for (const RecordingReport& r : recordings_) of_condition[r.condition].push_back(&r);
  std::vector<std::string> warnings;
  for (std::size_t c = 0; c < conditions_.size(); ++c) {
    const std::string &name = conditions_[c].name, &first = conditions_.front().name;
    if (const auto differences = differences_within(of_condition[c]); !differences.empty())
      warnings.push_back(fmt::format(
          "the recordings of {} differ in {}; each is read by its own map, but the cells need not be the same there. "
          "The increase of E as a power of the stress needs three flow rates in one channel and one medium.",
          name, differences));
    if (const auto differences = differences_between(of_condition.front(), of_condition[c]); !differences.empty())
      warnings.push_back(
          fmt::format("{} and {} differ in {}: their ratio is not that of the cells alone.", name, first, differences));
  }
  return warnings;
}

PopulationReport PopulationAnalysis::report() {
  model_->share(recordings_);
  PopulationReport report;
  report.model = model_->name();
  report.why_this_model = why_this_model_;
  report.elongation = model_->elongation_text();
  report.by = by_;
  report.between_recordings = options_.between_recordings;
  report.outline_noise_um = options_.outline_noise_um.value_or(0);
  report.recordings = recordings_;
  report.systematic_errors = model_->systematic_errors(recordings_);
  report.doses = doses_;
  report.dose_unit = options_.dose_unit;
  report.dose_responses = dose_reports(recordings_, doses_, options_.paired, report.level);
  report.tensions = tensions_of_setups(recordings_);
  report.warnings = unlike_recordings();
  if (options_.shared_spread)
    for (auto& remark : share_spreads(conditions_, report.level, report.recordings))
      report.warnings.push_back(std::move(remark));
  report.conditions = condition_reports(report.recordings, conditions_, report.level);
  report.comparisons = comparisons_of(report.recordings, conditions_.size(),
                                      {options_.paired, {report.level, options_.between_recordings}});
  return report;
}

}  // namespace

PopulationReport analyse(const std::vector<PopulationCondition>& conditions, const PopulationOptions& options,
                         const Watch& watch) {
  const auto shapes = shapes_of(conditions, options, watch);
  ChosenModel model = model_of_shapes(options, shapes);
  PopulationOptions decided = options;
  decided.model = model.name;
  const std::optional<StiffnessMeasure> measure =
      model.name == "effective" ? std::nullopt : std::optional(stiffness_measure_of(decided));
  PopulationAnalysis analysis(decided, conditions, std::move(model.why));
  double all = 0, done = 0;
  for (const auto& condition : conditions) all += double(condition.recordings.size());
  for (std::size_t c = 0; c < conditions.size(); ++c)
    for (std::size_t j = 0; j < conditions[c].recordings.size(); ++j) {
      watch.go_on();
      const auto& recording = conditions[c].recordings[j];
      const auto read = [&](const MeasuringOptions& measuring) {
        return read_isolated(recording, measuring, watch, [&](const TellProgress& report_progress) {
          return read_population_events(recording, measuring, measure,
                                        [&](double fraction) { report_progress((done + 0.5 * fraction) / all); });
        });
      };
      analysis.add({c, j, shapes[std::size_t(done)]}, read(options.measuring), watch);
      if (analysis.needs_all_shapes()) {
        MeasuringOptions lifted = options.measuring;
        lifted.lifts_shape_gates = true;
        analysis.compare(read(lifted));
      }
      watch.progress(++done / all);
    }
  return analysis.report();
}

}  // namespace rheocyte
