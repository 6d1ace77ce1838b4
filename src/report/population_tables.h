// Text tables of `rheocyte population`.
#pragma once
#include <string>
#include <string_view>

#include "experiment/population_recordings.h"

namespace rheocyte {

inline constexpr std::string_view mark_of_population_table = "condition\tsession\trecording\t";
inline constexpr std::string_view mark_of_population_events = "event\tyoung_modulus_kPa\tln_modulus_sd\t";

/// A line per recording.
std::string population_table(const PopulationReport& report);
/// Shrunken values of single events: their posterior means and standard deviations. Empty if events were binned, or
/// cells have a cortex.
std::string population_events_table(const RecordingReport& recording);

}  // namespace rheocyte
