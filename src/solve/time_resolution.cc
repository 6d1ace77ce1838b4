#include "solve/time_resolution.h"

#include <algorithm>
#include <cmath>

#include "solve/branch_ends.h"
#include "solve/duct.h"
#include "solve/resolved_branch.h"

namespace rheocyte {
namespace {

/// Of the ladder that the coarse resolutions are judged by, in the requested accuracy.
constexpr double fraction_of_reference = 0.1;
/// Of the requested accuracy that the stationary shape may use up: the way to it is not as smooth.
constexpr double fraction_of_stationary = 0.5;
/// The quarter of a duct that a funnel leaves has four to five times the unknowns of a square's stationary state.
constexpr int greatest_chosen_in_ducts = 5;

Resolution chosen(const Problem& problem, Resolution resolution) {
  if (is_duct(problem.section)) resolution.degree = std::min(resolution.degree, greatest_chosen_in_ducts);
  return resolution;
}

}  // namespace

Resolution resolution_in_time(const Problem& problem, double accuracy, const WorkLimits& limits) {
  Problem straight = problem;
  straight.wall = {};
  straight.offset = shape_of(problem).offset;
  if (!problem.tension_profile.is_even()) axial_tension(straight) = problem.tension_profile.tension.back();
  straight.accuracy = fraction_of_reference * accuracy;
  if (problem.bulk.shear_modulus == 0 && problem.bulk.branch_modulus > 0) return usual_time_resolution_of(problem);
  const Geometry geometry = solver_geometry(straight);
  if (geometry.knows_ends && is_far_too_soft(straight)) return usual_time_resolution_of(problem);
  ResolvedBranch branch(straight, geometry, {}, limits);
  ResolvedState state = branch.follow();
  if (state.status != Status::converged) return usual_time_resolution_of(problem);
  Ladder ladder{branch.geometry().errors};
  branch.climb(state, ladder);
  if (ladder.rungs.empty()) return usual_time_resolution_of(problem);
  const double best = ladder.deformation();
  for (std::size_t i = 0; i + 1 < ladder.rungs.size(); ++i) {
    const double error = std::abs(ladder.numbers[i].shape.deformation / best - 1) + ladder.estimated_error;
    if (error <= fraction_of_stationary * accuracy) return chosen(problem, ladder.rungs[i].discrete->resolution());
  }
  return chosen(problem, ladder.rungs.back().discrete->resolution());
}

Resolution to_compare_with(const Problem& problem, const Resolution& resolution) {
  const int min_degree = is_duct(problem.section) ? 3 : 2;
  return {resolution.subdivision, resolution.degree > min_degree ? resolution.degree - 1 : resolution.degree + 1};
}

}  // namespace rheocyte
