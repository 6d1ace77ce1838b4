// The columns of populations: their recordings, conditions, comparisons, checks and parameters. population.json,
// population.tsv, the tables and companions of single events, Python's data frames and the page's tables are made from
// them.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "experiment/population_recordings.h"
#include "report/column.h"

namespace rheocyte {

/// A parameter of the fitted law, on the scale on which its error is normally distributed.
struct ParameterRow {
  std::string_view name;
  double value, error, low, high;
  std::string_view interval;  ///< "profile" or "normal"; empty: there is none
  bool at_bound;
};

/// A check beside the recording to which it belongs.
struct CheckRow {
  std::string recording, condition;
  MeasureCheck check;
};

/// The posterior mean of a single event, whose number is counted from 1.
struct ShrunkenEvent {
  std::size_t event;
  ShrunkenCell cell;
};

const Columns<PopulationReport>& population_columns();
/// Names and units of the quantities, and the column that contains the median.
const Columns<PopulationQuantity>& quantity_columns();
/// The report must outlive these columns: its model and its quantities determine which there are.
Columns<RecordingReport> recording_columns(const PopulationReport& report);
Columns<ConditionReport> condition_columns(const PopulationReport& report);
Columns<DoseReport> dose_columns();
Columns<ConditionComparison> comparison_columns(const PopulationReport& report);
const Columns<ParameterRow>& parameter_columns();
const Columns<MeasureCheck>& check_columns();
const Columns<ThirdCheck>& third_columns();
const Columns<CheckRow>& check_row_columns();
const Columns<ShrunkenEvent>& shrunken_columns();

/// None if there is no number.
std::vector<ParameterRow> parameter_rows(const RecordingReport& recording);
std::vector<CheckRow> check_rows(const PopulationReport& report);
/// In the order of the events. None if events were binned, or cells have a cortex.
std::vector<ShrunkenEvent> shrunken_events(const RecordingReport& recording);

}  // namespace rheocyte
