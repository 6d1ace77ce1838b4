// Recordings of conditions, from their events to their comparison.
#pragma once
#include <vector>

#include "experiment/population_recordings.h"
#include "store/watch.h"

namespace rheocyte {

/// Reads the recordings one after another, each in a process of its own, fits their populations and compares the
/// conditions. `watch` gets the fraction that is done. StoppedBySignal once it wants the end. UserError for what is
/// wrong with options, tables or a recording: too few events, none inside the gates, gates that leave a tail, the same
/// measurement once more, an outline noise of more than a tenth of the median radius.
PopulationReport analyse(const std::vector<PopulationCondition>& conditions, const PopulationOptions& options,
                         const Watch& watch);

}  // namespace rheocyte
