// What recordings of one or several conditions say about their cells (docs/populations.md).
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "events/options.h"
#include "experiment/recording_report.h"
#include "population/comparison.h"
#include "population/dose_response.h"
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

/// A mean and its interval at the level of the report; NaN where there is none.
struct IntervalEstimate {
  double value = no_value, lower = no_value, upper = no_value;
};

struct ConditionQuantity {
  PopulationQuantity quantity;
  IntervalEstimate log_mean;
  bool is_by_recordings = false;  ///< the interval is that of the scatter of recordings; else the wider one of sampling
  double spread = no_value;       ///< between cells, mean over the recordings
  ScatterBetween between;
  std::optional<Stiffening> stiffening;  ///< if its recordings have three stresses by their flow rates
};

struct ConditionReport {
  std::string name;
  std::size_t recordings = 0, events = 0;       ///< with numbers; events that were fitted
  EventsBeyond beyond;                          ///< of these recordings
  std::size_t continued_events = 0;             ///< of these: fitted nevertheless
  std::vector<std::filesystem::path> left_out;  ///< recordings that could not be fitted
  std::filesystem::path without_numbers_by;     ///< the recording beyond the table for which there are none
  std::size_t seen_events() const { return events + beyond.all() - continued_events; }
  std::vector<ConditionQuantity> quantities;               ///< those that all its recordings give
  double log_radius = no_value, radius_spread = no_value;  ///< means over the recordings
  double elongation = no_value;                            ///< mean of the recordings' medians
  double wall_stress_Pa = no_value;  ///< geometric mean of theirs, at which means with a stiffening hold
  bool has_numbers() const { return !quantities.empty(); }
};

struct ConditionComparison {
  std::size_t control = 0, treated = 0;  ///< conditions
  PopulationQuantity quantity;
  bool is_paired = false;
  ConditionDifference difference;
};

/// How a quantity follows the dose of the conditions.
struct DoseReport {
  PopulationQuantity quantity;
  DoseResponse response;
};

struct PopulationReport {
  std::string model, elongation, systematic_errors;  ///< those of PopulationModel
  std::string why_this_model;                        ///< where the shapes of the cells decide
  StiffnessMeasure by = StiffnessMeasure::asymmetry;
  double level = 0.95;
  std::optional<double> between_recordings;
  double outline_noise_um = 0;
  std::vector<RecordingReport> recordings;
  std::vector<ConditionReport> conditions;
  std::vector<ConditionComparison> comparisons;
  std::vector<double> doses;  ///< of the conditions, NaN without one; empty: none is given
  std::string dose_unit;
  std::vector<DoseReport> dose_responses;
  std::vector<std::string> tensions;  ///< whether those of a set-up are one (experiment/tension_of_setup.h)
  std::vector<std::string> warnings;

  bool has_failures() const;
  /// Of any recording, in the order in which the model gives them.
  std::vector<PopulationQuantity> quantities() const;
};

}  // namespace rheocyte
