// What the recordings of a condition say together, and how conditions differ (docs/theory-populations.md, sec.
// "Conditions").
#pragma once
#include <string>
#include <vector>

#include "experiment/population_recordings.h"

namespace rheocyte {

/// Of each condition, by those of its recordings that have numbers. A recording that could not be fitted is left out by
/// name; one whose cells lie beyond the table leaves its condition without numbers, because the rest is
/// selected.
std::vector<ConditionReport> condition_reports(const std::vector<RecordingReport>& recordings,
                                               const std::vector<PopulationCondition>& conditions, double level);

struct ComparisonRules {
  bool is_paired = false;  ///< by sessions that have both conditions
  ComparisonSettings settings;
};
/// Of each condition but the first with this one, in each quantity that both have.
std::vector<ConditionComparison> comparisons_of(const std::vector<RecordingReport>& recordings, std::size_t conditions,
                                                const ComparisonRules& rules);

/// Of any recording, in the order in which a model gives them.
std::vector<PopulationQuantity> quantities_told(const std::vector<RecordingReport>& recordings);

}  // namespace rheocyte
