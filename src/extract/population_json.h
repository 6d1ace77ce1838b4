// Files and lines of `rheocyte population`.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "extract/population_recordings.h"

namespace rheocyte {

inline constexpr std::string_view mark_of_population_json = "{\n  \"made_by\": \"rheocyte population\"";
inline constexpr std::string_view mark_of_population_table = "condition\tsession\trecording\t";
inline constexpr std::string_view mark_of_population_events = "event\tyoung_modulus_kPa\tln_modulus_sd\t";

/// All settings, parameters with their covariances, intervals, comparisons and checks.
std::string population_json(const PopulationReport& report);
/// A line per recording.
std::string population_table(const PopulationReport& report);
/// Shrunken values of single events: their posterior means and standard deviations. Empty if events were binned.
std::string population_events_table(const RecordingReport& recording);

/// For the terminal: one line per condition and comparison, the checks, the systematic errors.
std::vector<std::string> population_lines(const PopulationReport& report);

}  // namespace rheocyte
