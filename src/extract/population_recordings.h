// What recordings of one or several conditions say about their cells (docs/populations.md).
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "extract/options.h"
#include "extract/population_check.h"
#include "extract/population_sample.h"
#include "population/comparison.h"
#include "population/fit_cells.h"
#include "population/single_images.h"
#include "population/stiffening.h"

namespace rheocyte {

struct PopulationCondition {
  std::string name;
  std::vector<std::filesystem::path> recordings;
};

/// Of the options' texts NAME=FILE,FILE,...; UserError as check_conditions, and for a text that is none.
std::vector<PopulationCondition> conditions_of(const PopulationOptions& options);
/// UserError: no condition, one without recordings, a name or a recording twice, pairs that are none.
void check_conditions(const std::vector<PopulationCondition>& conditions, bool paired);
/// UserError if it is no such word.
StiffnessMeasure stiffness_measure_of(const PopulationOptions& options);
std::string_view name_of(StiffnessMeasure by);

/// One recording; its events stay outside.
struct RecordingReport {
  std::filesystem::path recording;
  std::size_t condition = 0, session = 0;  ///< counted from 0
  ChannelFlow flow;
  double pixel_size_um = 0, median_viscosity_mPas = 0, median_elongation = 0;
  int direction = 0;
  std::string table, gates;
  double table_error = 0;
  std::size_t recorded = 0, gated = 0, without_numbers = 0, beside_table = 0, fitted_events = 0;
  bool is_binned = false;
  FittedCells fitted;
  SingleImages images;
  std::vector<MeasureCheck> checks;
  std::vector<std::size_t> shrunken_events;  ///< number of the event, from 1 on, of each of fitted.shrunken
  std::vector<std::string> settings, warnings;
  std::string failure;  ///< why there is no number, in a sentence; else empty

  RecordingMean mean() const;
  /// At the wall without a cell, at the median viscosity.
  double wall_stress_Pa() const;
};

/// A mean and its interval at the level of the report; NaN where there is none.
struct IntervalEstimate {
  double value = no_value, lower = no_value, upper = no_value;
};

struct ConditionReport {
  std::string name;
  std::size_t recordings = 0, events = 0;
  IntervalEstimate log_modulus;   ///< of the mean of ln E
  bool is_by_recordings = false;  ///< the interval is that of the scatter of recordings; else of sampling
  double modulus_spread = no_value, log_radius = no_value, radius_spread = no_value;  ///< means over the recordings
  double elongation = no_value;  ///< median of the recordings' medians
  ScatterBetween between;
  std::optional<Stiffening> stiffening;  ///< if its recordings have different stresses
  double wall_stress_Pa = no_value;      ///< geometric mean of them, at which log_modulus holds
  bool has_numbers() const { return std::isfinite(log_modulus.value); }
};

struct ConditionComparison {
  std::size_t control = 0, treated = 0;  ///< conditions
  bool is_paired = false;
  ConditionDifference difference;
};

struct PopulationReport {
  StiffnessMeasure by = StiffnessMeasure::asymmetry;
  double level = 0.95;
  std::optional<double> between_recordings;
  std::vector<RecordingReport> recordings;
  std::vector<ConditionReport> conditions;
  std::vector<ConditionComparison> comparisons;
  std::vector<std::string> warnings;

  bool has_failures() const;
};

/// Takes the recordings one after the other, in the order of the conditions.
class PopulationAnalysis {
 public:
  /// UserError if tables are missing.
  PopulationAnalysis(const PopulationOptions& options, std::vector<PopulationCondition> conditions);

  /// Fits the population of a recording. UserError: too few events, none inside the gates, gates that leave a tail, the
  /// same measurement once more.
  const RecordingReport& add(std::size_t condition, std::size_t session, const PopulationEvents& events);
  /// Of all that were added.
  PopulationReport report() const;

 private:
  RecordingReport described(std::size_t condition, std::size_t session, const PopulationEvents& events) const;
  void check_new(const RecordingReport& recording, const PopulationEvents& events);

  PopulationOptions options_;
  std::vector<PopulationCondition> conditions_;
  StiffnessMeasure by_;
  PopulationMaps maps_;
  std::vector<RecordingReport> recordings_;
  std::vector<std::vector<double>> first_areas_;  ///< of each recording: by these the same measurement is known again
};

}  // namespace rheocyte
