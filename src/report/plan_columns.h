// The columns of the channels of `rheocyte plan`.
#pragma once
#include <string_view>

#include "experiment/experiment_plan.h"
#include "report/column.h"

namespace rheocyte {

inline constexpr std::string_view mark_of_plan = "channel_width_um\tmedium\tflow_rate_ul_per_s\t";
/// Of version 0.3.0.
inline constexpr std::string_view former_mark_of_plan = "width_um\tmedium\trate_ul_per_s\t";

const Columns<PlannedChannel>& plan_columns();

}  // namespace rheocyte
