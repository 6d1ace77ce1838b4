// Columns of one quantity of cells, with the same names for recordings and conditions, solids and cells with a cortex.
#pragma once
#include <string_view>

#include "experiment/population_recordings.h"
#include "report/column.h"

namespace rheocyte {

/// `level`: of the intervals.
Columns<QuantityEstimate> columns_of_recordings(PopulationQuantity quantity, double level);
Columns<ConditionQuantity> columns_of_conditions(PopulationQuantity quantity);

/// What an interval is by, in words.
std::string_view interval_words(bool is_by_recordings);

}  // namespace rheocyte
