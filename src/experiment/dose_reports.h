// Doses of the conditions, and how the numbers of the cells follow them.
#pragma once
#include <string>
#include <vector>

#include "experiment/population_recordings.h"

namespace rheocyte {

/// Of each condition; NaN without one, 0 of the first condition if nothing else is given. Empty where no dose is given.
/// UserError: a text that is not NAME=VALUE, a condition that is none, a negative dose.
std::vector<double> doses_of(const std::vector<std::string>& texts, const std::vector<PopulationCondition>& conditions);

/// Of each quantity that recordings of at least two doses have. `is_paired`: by sessions.
std::vector<DoseReport> dose_reports(const std::vector<RecordingReport>& recordings, const std::vector<double>& doses,
                                     bool is_paired, double level);

}  // namespace rheocyte
