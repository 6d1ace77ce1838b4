// Where a branch ends: round its fold by arc length (docs/theory.md, eq:arclength).
#include <utility>

#include "solve/arclength.h"
#include "solve/metered.h"
#include "solve/resolved_branch.h"

namespace rheocyte {
namespace {

/// Where a way ends: of Newton's failures, any.
bool is_unexplained(Status status) {
  return status == Status::iteration_limit || status == Status::branch_ended || status == Status::mesh_folded ||
         status == Status::singular_matrix;
}

/// So often the mesh is fitted where a branch is traced.
constexpr int max_traces = 6;

/// Of the compliance, between two ends of a way at which its mesh is fitted: near a fold fits gain ever less.
constexpr double least_gain_by_fit = 5e-3;

}  // namespace

bool ResolvedBranch::trace(ResolvedState& state, const ContinuationOptions& options) {
  Discrete& discrete = *state.discrete;
  const Metered metered(*this, discrete.system());
  ArcOptions arc;
  arc.newton = options.newton;
  arc.newton.tolerance = geometry_.fine.tolerance;
  arc.newton.iteration_limit = geometry_.across.iteration_limit;
  arc.max_correction = options.max_correction;
  arc.fold_limit = 1;
  const Accept accept = smooth();
  bool is_refused = false;
  arc.go_on = [&](const BranchState& found) {
    if (found.parameter >= 1 || discrete.is_worn(found.unknowns)) return false;
    is_refused = !accept(discrete, found);
    return !is_refused;
  };
  ArcReport report = trace_arc(stiffness_path(discrete.system(), media_), arc, state.branch);
  statistics_.newton_iterations += report.newton_iterations;
  if (report.states.size() < 2) return state.status = report.status, false;
  statistics_.continuation_steps += int(report.states.size()) - 1;
  const bool turns = !report.folds.empty();
  // Not the one beyond the fold, the surface's limit, or the requested compliance.
  const bool is_beyond = turns || is_refused || report.states.back().parameter >= 1;
  const std::size_t last = report.states.size() - 1 - (is_beyond ? 1 : 0);
  const bool gains = last > 0;
  if (turns) state.turning = turning_parameter(report, report.folds.front());
  state.status = turns ? Status::limit_point : is_refused ? Status::surface_unstable : report.status;
  if (gains) {
    state.branch = std::move(report.states[last]);
    state.branch.tangent /= report.slopes[last];
  }
  if (!is_beyond || turns || is_refused) return gains;
  // Between the last two states.
  const BranchState &before = state.branch, &after = report.states.back();
  const double fraction = (1 - before.parameter) / (after.parameter - before.parameter);
  ResolvedState found =
      solved(state.discrete, 1, before.unknowns + fraction * (after.unknowns - before.unknowns), options.newton);
  if (found.status == Status::converged) state = std::move(found);
  return gains;
}

void ResolvedBranch::go_on(ResolvedState& state, const CoarseWay& way, const ContinuationOptions& options) {
  if (!geometry_.traces_ends || way.fits == Fits::once) return advance(state, 1, options, smooth(), way.fits);
  const auto go_here = [&](bool pauses) { return go(state, 1, options, smooth(), pauses); };
  const auto fit_here = [&] {
    if (is_unexplained(state.status)) {
      const Status before = state.status;
      const bool gains = trace(state, options);
      if (state.status == Status::limit_point || state.status == Status::surface_unstable || is_stopped() ||
          state.branch.parameter >= 1)
        return false;
      if (!gains || state.status == Status::converged) state.status = before;
    }
    return fit(state, options.newton);
  };
  fit_on_the_way(1, go_here, fit_here, least_gain_by_fit);
}

void ResolvedBranch::look_beyond(ResolvedState& state, const ContinuationOptions& options) {
  for (int i = 0; i < max_traces && is_unexplained(state.status) && !is_stopped(); ++i) {
    const Status before = state.status;
    const bool gains = trace(state, options);
    if (state.status == Status::stopped || state.status == Status::limit_point ||
        state.status == Status::surface_unstable || state.branch.parameter >= 1)
      return;
    if (!gains) state.status = before;
    if (!fit(state, options.newton) && !gains) return;
    if (state.status == Status::converged) state.status = Status::branch_ended;
  }
}

}  // namespace rheocyte
