#include "solve/stationary.h"

#include "solve/session.h"

namespace rheocyte {

StationaryState solve_stationary(const Problem& problem, const ProgressCallback& progress, const WorkLimits& limits,
                                 std::span<ProblemLine> lines) {
  return Session(0).solve(problem, progress, limits, lines);
}

}  // namespace rheocyte
