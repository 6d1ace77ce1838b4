#include "table/sample_square_branch.h"

#include <chrono>

#include "case/scales.h"
#include "numeric/lagrange.h"
#include "solve/duct_branch.h"
#include "table/measured_state.h"
#include "table/square_branches.h"

namespace rheocyte {
namespace {

/// Shares of sqrt(d) at the last state: the points of Chebyshev's polynomials between the least one and 1.
std::vector<double> heights(int count) {
  constexpr double least = 0.05;
  return chebyshev_points(least, 1, count);
}

}  // namespace

SampledBranch sample_square_branch(const TableSpec& spec, const BranchPlace& place, const std::atomic<bool>* stop) {
  const auto start = std::chrono::steady_clock::now();
  // Any stiffness: that of the liquid's stress makes the first states of the branch stiffer by a factor of 10 to 100.
  const Scales scales = scales_of(case_at(spec, place, 1));
  const double stiffness = 1e-3 * scales.stress_Pa;
  const auto problem_at = [&](double compliance) { return problem_of(case_at(spec, place, stiffness / compliance)); };
  const auto found = follow_in_duct(problem_at(1), problem_at, spec.max_deformation,
                                    heights(spec.computed_states.value()), spec.bending_from_margin, stop);

  SampledBranch branch;
  branch.radius_um = place.radius_um;
  const Status end = stop && *stop ? Status::stopped : found.end;
  branch.end = end_of(end == Status::converged ? Status::covered : end);
  branch.value.resize(std::ssize(found.states), measure_count);
  for (const StationaryState& state : found.states) {
    MeasuredState measured = measure_state(state, scales);
    branch.value.row(branch.samples()) = measured.value.transpose();
    branch.stiffness.push_back(stiffness / state.outcome.reached);
    branch.contour.push_back(std::move(measured.contour));
    branch.error.push_back(state.estimated_error);
    branch.newton_iterations += state.statistics.newton_iterations;
    branch.factorisation_seconds += state.statistics.factorisation_s;
  }
  branch.solves = branch.samples();
  set_slopes(branch);
  branch.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return branch;
}

SampledBranch sample_held_square_branch(const TableSpec& spec, const BranchPlace& place,
                                        const std::atomic<bool>* stop) {
  SampledBranch branch = sample_square_branch(held_spec(spec), place, stop);
  if (!branch.empty()) branch.bending_kBT = held_bending_kBT(spec, place.radius_um, branch.stiffness.back());
  return branch;
}

}  // namespace rheocyte
