#include "solve/time_resolution.h"

#include <cmath>

#include "solve/branch_ends.h"
#include "solve/resolved_branch.h"
#include "solve/tube.h"

namespace rheocyte {
namespace {

/// Of the ladder that the coarse resolutions are judged by, in the wanted accuracy.
constexpr double share_of_reference = 0.1;
/// Of the wanted accuracy that the stationary shape may use up: the way to it is not as smooth.
constexpr double share_of_stationary = 0.5;

}  // namespace

Resolution resolution_in_time(const Problem& problem, double accuracy, const std::atomic<bool>* stop) {
  Problem straight = problem;
  straight.wall = {};
  if (!problem.tension_profile.is_even()) axial_tension(straight) = problem.tension_profile.tension.back();
  straight.accuracy = share_of_reference * accuracy;
  if (problem.bulk.shear_modulus == 0 && problem.bulk.branch_modulus > 0) return usual_time_resolution;
  if (is_far_too_soft(straight)) return usual_time_resolution;
  ResolvedBranch branch(straight, tube_geometry(straight), {}, stop);
  ResolvedState state = branch.follow();
  if (state.status != Status::converged) return usual_time_resolution;
  Ladder ladder{branch.geometry().errors};
  branch.climb(state, ladder);
  if (ladder.rungs.empty()) return usual_time_resolution;
  const double best = ladder.deformation();
  for (std::size_t i = 0; i + 1 < ladder.rungs.size(); ++i) {
    const double error = std::abs(ladder.numbers[i].shape.deformation / best - 1) + ladder.estimated_error;
    if (error <= share_of_stationary * accuracy) return ladder.rungs[i].discrete->resolution();
  }
  return ladder.rungs.back().discrete->resolution();
}

Resolution to_compare_with(const Resolution& resolution) {
  constexpr int min_degree = 2;
  return {resolution.subdivision, resolution.degree > min_degree ? resolution.degree - 1 : resolution.degree + 1};
}

}  // namespace rheocyte
