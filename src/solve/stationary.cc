#include "solve/stationary.h"

#include "solve/session.h"

namespace rheocyte {

std::vector<Eigen::Index> SurfaceProfile::distinct_rows() const {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < point.rows(); ++i)
    if (i == 0 || i % points_per_piece != 0) rows.push_back(i);
  return rows;
}

StationaryState solve_stationary(const Problem& problem, const ProgressCallback& progress, const WorkLimits& limits,
                                 std::span<ProblemLine> lines) {
  return Session(0).solve(problem, progress, limits, lines);
}

}  // namespace rheocyte
