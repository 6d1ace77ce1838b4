// What a plan says, in sentences.
#pragma once
#include <string>
#include <vector>

#include "experiment/experiment_plan.h"

namespace rheocyte {

/// The best channel, the sessions that it takes, and what limits.
std::vector<std::string> plan_lines(const PlanOptions& options, const ExperimentPlan& plan);

/// UserError where no channel shows the cells: why, and which stress would.
[[noreturn]] void refuse_all(const PlanOptions& options, const std::vector<PlannedChannel>& channels);

}  // namespace rheocyte
