// The end of a computation in time as result.json contains it, and what a case asks for in time.
#pragma once
#include "result/result.h"
#include "result/time_record.h"

namespace rheocyte {

/// What the section [time] of a case asks for, in the units of its problem.
TimeRun time_run_of(const Case&, const Scales&);

/// The content of result.json: that of the last state, and "time", null without a step.
nlohmann::ordered_json to_json(const Result&, const TimeRecord&);

}  // namespace rheocyte
