// The record of `rheocyte population`.
#pragma once
#include <string>
#include <string_view>

#include "experiment/population_recordings.h"

namespace rheocyte {

inline constexpr std::string_view mark_of_population_json = "{\n  \"made_by\": \"rheocyte population\"";

/// All settings, parameters with their covariances, intervals, comparisons and checks.
std::string population_json(const PopulationReport& report);

}  // namespace rheocyte
