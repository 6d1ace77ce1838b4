#include "report/population_files.h"

#include <nlohmann/json.hpp>

#include "case/json_guard.h"
#include "report/methods_text.h"
#include "report/population_columns.h"
#include "report/rows_json.h"
#include "report/rows_text.h"
#include "store/build_info.h"

namespace rheocyte {
namespace {

using nlohmann::ordered_json;

constexpr int population_schema = 2;

ordered_json covariance_json(const ParameterMatrix& covariance) {
  ordered_json rows = ordered_json::array();
  for (const auto& of_row : covariance.rowwise()) rows.emplace_back(std::vector<double>(of_row.begin(), of_row.end()));
  return rows;
}

ordered_json images_json(const SingleImages& images) {
  return {
      {"ln_modulus_from", images.first}, {"step", images.step}, {"counts", images.counts}, {"without", images.without}};
}

ordered_json check_json(const MeasureCheck& check) {
  ordered_json json = row_json(check_columns(), check);
  json["measured_quantiles"] = check.measured_quantiles;
  json["predicted_quantiles"] = check.predicted_quantiles;
  json["thirds_by_area"] = rows_json(third_columns(), check.thirds);
  return json;
}

/// The row, and what is a list.
ordered_json recording_json(const Columns<RecordingReport>& columns, const RecordingReport& r) {
  ordered_json json = row_json(columns, r);
  json["parameters"] = rows_json(parameter_columns(), parameter_rows(r));
  if (r.failure.empty() && !r.combined && !r.effective) {
    json["covariance"] = covariance_json(r.fitted.covariance);
    json["moduli_of_single_images"] = images_json(r.images);
  }
  ordered_json& checks = json["checks"] = ordered_json::array();
  for (const MeasureCheck& check : r.checks) checks.push_back(check_json(check));
  json["settings"] = r.settings;
  json["warnings"] = r.warnings;
  return json;
}

}  // namespace

ordered_json population_record(const PopulationReport& report) {
  ordered_json record{{"made_by", "rheocyte population"}, {"version", version}, {"schema", population_schema}};
  record.update(row_json(population_columns(), report));
  record["quantities"] = rows_json(quantity_columns(), report.quantities());
  record["conditions"] = rows_json(condition_columns(report), report.conditions);
  record["comparisons"] = rows_json(comparison_columns(report), report.comparisons);
  ordered_json& recordings = record["recordings"] = ordered_json::array();
  const auto columns = recording_columns(report);
  for (const RecordingReport& r : report.recordings) recordings.push_back(recording_json(columns, r));
  if (!report.doses.empty()) {
    record["doses"] = ordered_json{{"unit", report.dose_unit}, {"of_conditions", report.doses}};
    record["dose_responses"] = rows_json(dose_columns(), report.dose_responses);
  }
  record["tensions"] = report.tensions;
  record["methods"] = methods_text(report);
  record["warnings"] = report.warnings;
  return record;
}

std::string population_json(const PopulationReport& report) { return json_text(population_record(report)) + "\n"; }

std::string population_table(const PopulationReport& report) {
  return rows_text(recording_columns(report), report.recordings);
}

std::string population_events_table(const RecordingReport& recording) {
  const auto events = shrunken_events(recording);
  return events.empty() ? std::string() : rows_text(shrunken_columns(), events);
}

}  // namespace rheocyte
