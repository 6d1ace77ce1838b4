// The files of `rheocyte population`, made from the columns of report/population_columns.h.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "experiment/population_recordings.h"

namespace rheocyte {

inline constexpr std::string_view mark_of_population_json = "{\n  \"made_by\": \"rheocyte population\"";
inline constexpr std::string_view mark_of_population_table = "condition\tsession\trecording\t";
/// Also that of files of version 0.3.0, whose other columns had other names.
inline constexpr std::string_view mark_of_population_events = "event\tyoung_modulus_kPa\t";

/// All settings, parameters with their covariances, intervals, comparisons and checks.
nlohmann::ordered_json population_record(const PopulationReport& report);
/// The same as the text of population.json.
std::string population_json(const PopulationReport& report);
/// A line per recording.
std::string population_table(const PopulationReport& report);
/// Posterior means and standard deviations of single events; empty if there are none.
std::string population_events_table(const RecordingReport& recording);

}  // namespace rheocyte
