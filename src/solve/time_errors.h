// How far off the numbers of a cell on its way are (docs/theory-time.md, eq:error-in-time).
#pragma once
#include "solve/transient.h"

namespace rheocyte {

/// A run that has reached its end.
struct FollowedRun {
  const Problem& problem;
  const TimeRun& run;
  Resolution resolution;
  TimeWay way;
  bool has_settled = false, is_at_place = false;
};

/// Sets errors, message and `comparison` of the run's last state by the same run with coarser steps, which also goes to
/// another mesh or two. A signal on the way leaves the errors unknown, and the status says so. The errors of all steps
/// and outputs; empty where they are not known.
TimeWay estimate_errors(const FollowedRun&, const WorkLimits&, StationaryState& result);

}  // namespace rheocyte
