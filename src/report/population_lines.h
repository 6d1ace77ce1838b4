// What `rheocyte population` prints.
#pragma once
#include <string>
#include <vector>

#include "experiment/population_recordings.h"

namespace rheocyte {

/// Conditions, comparisons, checks and systematic errors, a line each.
std::vector<std::string> population_lines(const PopulationReport& report);

}  // namespace rheocyte
