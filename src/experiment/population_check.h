// Whether a fitted population has the measures of its events, also those that were not fitted
// (docs/theory-populations.md, sec. "Checks").
#pragma once
#include <vector>

#include "experiment/measure_check.h"
#include "experiment/population_sample.h"
#include "population/fit_cells.h"

namespace rheocyte {

/// Of the events of the sample; the population is drawn with the elongations and viscosities of the events.
std::vector<MeasureCheck> check_population(const PopulationEvents& events, const PopulationSample& sample,
                                           const FittedCells& fitted, PopulationMaps& maps);

}  // namespace rheocyte
