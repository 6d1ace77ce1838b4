// What each step of a run in time leaves as an error, by the run itself (docs/theory-time.md, eq:local-error).
#pragma once
#include <vector>

#include "solve/time_way.h"

namespace rheocyte {

/// Level by level, absolute. Nothing is left at the start, nor of a number that is not known.
struct LocalErrors {
  std::vector<StateNumbers> numbers;
  std::vector<double> positions;  ///< sums of those of all steps so far
};

/// Of the levels of a run from its start, the ends of its steps: how far each number is from that extrapolated
/// from the levels before it, times the fraction of the step's formula (eq:step-error). To that of the position comes
/// that of the velocity with which the step has placed the cell.
LocalErrors local_errors(const std::vector<TimePoint>& levels);

}  // namespace rheocyte
