// From one resolution of a branch to the next finer one, and from one problem to a neighbouring one.
#include <algorithm>
#include <limits>
#include <utility>

#include "solve/resolved_branch.h"
#include "solve/surface_stability.h"
#include "solve/warm_start.h"

namespace rheocyte {

void ResolvedBranch::add(const ResolvedState& state, Ladder& ladder) const {
  ladder.add(state, state.discrete->numbers(problem_at(state.branch.parameter), state.branch.unknowns));
}

void ResolvedBranch::report_last(const Ladder& ladder) {
  const ResolvedState& last = ladder.rungs.back();
  report(*last.discrete, last.branch, ladder.deformation());
}

bool ResolvedBranch::only_begins(const ResolvedState& state) const {
  const auto own = std::ranges::find(geometry_.rungs, state.discrete->resolution().subdivision, &Rungs::subdivision);
  if (own == geometry_.rungs.end()) return false;
  return own->only_begins || (own->is_rough_at_rims && state.discrete->is_fitted());
}

bool ResolvedBranch::is_accurate(const Ladder& ladder) const {
  if (ladder.rungs.size() < 2 || only_begins(ladder.rungs.back())) return false;
  return ladder.stated_error(problem_) <= problem_.accuracy;
}

Status ResolvedBranch::climb(ResolvedState& state, Ladder& ladder) {
  if (ladder.rungs.empty() && geometry_.begins_with_way) {
    add(state, ladder);
    report_last(ladder);
  }
  if (is_accurate(ladder)) return Status::converged;
  Status reason = Status::accuracy_not_reached;
  for (const Rungs& rungs : geometry_.rungs) {
    if (rungs.subdivision.top < state.discrete->resolution().subdivision.top) continue;
    const bool same_mesh = rungs.subdivision == state.discrete->resolution().subdivision;
    Ladder before{geometry_.errors};  // a new mesh at a lower degree need not be better at once
    const bool goes_on = rungs.goes_on || (!ladder.rungs.empty() && only_begins(ladder.rungs.back()));
    if (!same_mesh && !goes_on) std::swap(ladder, before);
    const Status status = climb_on(rungs, state, ladder);
    if (!before.rungs.empty() && !(ladder.estimated_error <= before.estimated_error)) {
      std::swap(ladder, before);
      state = ladder.rungs.back();
    }
    const bool is_final = status == Status::surface_unstable && surface_kind(problem_) == SurfaceKind::held;
    if (status == Status::converged || status == Status::stopped || is_final) return status;
    if (status == Status::surface_unstable || geometry_.rungs.size() == 1) reason = status;
  }
  if (!ladder.rungs.empty() && only_begins(ladder.rungs.back()))
    ladder.estimated_error = std::numeric_limits<double>::infinity();
  return reason;
}

/// On one mesh: why it cannot hold the state, or that its last degree is not accurate enough.
Status ResolvedBranch::climb_on(const Rungs& rungs, ResolvedState& state, Ladder& ladder) {
  const bool same_mesh = rungs.subdivision == state.discrete->resolution().subdivision;
  int degree = rungs.first_degree;
  if (same_mesh) degree = std::max(degree, state.discrete->resolution().degree + (ladder.rungs.empty() ? 0 : 1));
  for (; degree <= rungs.last_degree; ++degree) {
    // Two degrees' factors at a time would take the most memory.
    if (!keeps_factors_) state.discrete->system().drop_factors();
    ResolvedState next = at_resolution(state, {rungs.subdivision, degree});
    if (next.status == Status::stopped) return next.status;
    if (next.status == Status::converged && geometry_.judges_rungs && is_wrinkled(next))
      next.status = Status::accuracy_not_reached;
    if (next.status != Status::converged) return is_nearly_unstable(next) ? Status::surface_unstable : next.status;
    state = std::move(next);
    add(state, ladder);
    report_last(ladder);
    if (is_accurate(ladder)) return Status::converged;
    if (state.discrete->is_fitted() && only_begins(state)) break;
  }
  return Status::accuracy_not_reached;
}

namespace {

/// Chord steps end just below the tolerance, where Newton's own end far below it: volumes were off by 3e-9.
constexpr double of_chord_steps = 0.1;

}  // namespace

Status ResolvedBranch::carry(const Problem& from, const Ladder& former, Ladder& ladder) {
  const double growth = problem_.radius_ratio / from.radius_ratio;
  VectorXd before;  // of the last rung, on the mesh of this problem
  for (const ResolvedState& rung : former.rungs) {
    if (rung.discrete->resolution().degree < geometry_.rungs.front().first_degree) continue;  // of a rougher problem
    Discrete& discrete = *rung.discrete;
    VectorXd kept = rung.branch.unknowns;
    if (!has_same_mesh(from, problem_)) {
      discrete.move_to(problem_);
      discrete.system().scale_displacement(growth, kept);
    }
    VectorXd guess = kept;
    if (geometry_.adds_lower_change && !ladder.rungs.empty()) {
      const ResolvedState& lower = ladder.rungs.back();
      guess += discrete.transfer_from(*lower.discrete, lower.branch.unknowns) -
               discrete.transfer_from(*lower.discrete, before);
    }
    NewtonOptions options = geometry_.fine;
    options.keep_factors = discrete.system().has_factors();
    options.tolerance *= of_chord_steps;
    const ResolvedState found = solved(rung.discrete, 1, std::move(guess), options);
    if (found.status == Status::stopped) return found.status;
    const bool is_near = found.status == Status::converged &&
                         discrete.system().stretch_change(kept, found.branch.unknowns) < max_stretch_change &&
                         !is_wrinkled(found);
    if (!is_near) return Status::branch_ended;
    add(found, ladder);
    if (is_accurate(ladder)) break;
    before = std::move(kept);
  }
  report_last(ladder);
  return Status::converged;
}

}  // namespace rheocyte
