// One spread of radius and modulus for all recordings of a condition.
#pragma once
#include <string>
#include <vector>

#include "experiment/population_recordings.h"

namespace rheocyte {

/// Of solids. A recording with a spread at its bound keeps its own. Returns what is to be said of conditions whose
/// recordings scatter differently.
std::vector<std::string> share_spreads(const std::vector<PopulationCondition>& conditions, double level,
                                       std::vector<RecordingReport>& recordings);

}  // namespace rheocyte
