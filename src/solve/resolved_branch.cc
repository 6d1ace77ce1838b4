#include "solve/resolved_branch.h"

#include <algorithm>
#include <array>

namespace rheocyte {

namespace {

/// Resolutions of the way along the branch. Coarse ones cost 3 ms per Newton iteration and mostly go all the way;
/// near the end of the branch the rear shoulder and the front tip need the fine ones.
const std::array<Resolution, 4> meshes_on_the_way = {
    {{{2, 4, 1, 2}, 4}, {{2, 4, 1, 2}, 6}, {{3, 6, 1, 2}, 6}, {{3, 6, 1, 2}, 8}}};

constexpr std::size_t ways_of_quick_search = 2;

/// Least step (relative) where a finer resolution can go on, and where none can.
constexpr double min_branch_step_before_refining = 0.03, min_branch_step_at_last = 2e-3;
/// Intermediate states serve as starting points only.
constexpr double branch_tolerance = 1e-7;

std::shared_ptr<Discrete> discretise(const Problem& problem, const Resolution& resolution) {
  return std::make_shared<Discrete>(problem, resolution);
}

/// Carries a branch state over and converges it there; status says whether it stayed the same state.
ResolvedState carry_over(const Problem& problem, const NewtonOptions& options, const ResolvedState& from,
                         const Resolution& resolution) {
  ResolvedState to;
  to.resolution = resolution;
  to.discrete = discretise(problem, resolution);
  to.branch.parameter = from.branch.parameter;
  const VectorXd guess = transfer(from.discrete->space, from.branch.unknowns, to.discrete->space);
  to.branch.unknowns = guess;
  const NewtonReport report =
      newton(to.discrete->system, media_at(problem, to.branch.parameter), options, to.branch.unknowns);
  to.status = report.status;
  to.residual = report.residual;
  to.newton_iterations = report.iterations;
  to.work = to.discrete->system.work();
  return to;
}

void advance(const Problem& problem, const ContinuationOptions& options, ResolvedState& state) {
  const WorkMeter before = state.discrete->system.work();
  const ContinuationReport report =
      continue_branch(stiffness_path(state.discrete->system, problem), options, state.branch);
  state.status = report.status;
  state.branch = report.last;
  state.residual = report.residual;
  state.steps += report.steps;
  state.newton_iterations += report.newton_iterations;
  state.work += state.discrete->system.work() - before;
}

ResolvedState start(const Problem& problem, const ContinuationOptions& options, const Resolution& resolution) {
  ResolvedState state;
  state.resolution = resolution;
  state.discrete = discretise(problem, resolution);
  const ContinuationReport report = start_branch(stiffness_path(state.discrete->system, problem), options);
  state.status = report.status;
  state.branch = report.last;
  state.residual = report.residual;
  state.steps = report.steps;
  state.newton_iterations = report.newton_iterations;
  state.work = state.discrete->system.work();
  return state;
}

/// The last state at another resolution, or the first state of the branch there if the last one does not hold: Newton
/// leaves it, or the finer surface is seen to be wrinkled. In the latter case it is forgotten (its compliance set to
/// 0).
ResolvedState enter(const Problem& problem, const ContinuationOptions& options, ResolvedState& from,
                    const Resolution& resolution) {
  if (!from.discrete) return start(problem, options, resolution);
  NewtonOptions patient = options.newton;
  patient.iteration_limit = NewtonOptions{}.iteration_limit;
  ResolvedState state = carry_over(problem, patient, from, resolution);
  if (state.status == Status::stopped) return state;
  if (state.status == Status::converged) {
    const Problem here = at_compliance(problem, state.branch.parameter);
    if (!is_wrinkled(here, state.discrete->space, state.branch.unknowns)) return state;
    from.branch.parameter = 0;
  }
  const ResolvedState failed = state;
  state = start(problem, options, resolution);
  state.newton_iterations += failed.newton_iterations;
  state.work += failed.work;
  return state;
}

ContinuationOptions options_on_the_way(const Problem& problem, const NewtonOptions& newton, bool last,
                                       const BranchObserver& observe) {
  ContinuationOptions options;
  options.accept = [observe, problem](const NonlinearSystem& system, const BranchState& branch) {
    const Discretisation& space = space_of(system);
    if (is_wrinkled(at_compliance(problem, branch.parameter), space, branch.unknowns)) return false;
    if (observe) observe(space, branch);
    return true;
  };
  options.newton = newton;
  options.newton.tolerance = branch_tolerance;
  options.newton.iteration_limit = 5;
  options.min_step = last ? min_branch_step_at_last : min_branch_step_before_refining;
  return options;
}

/// Whether the ends of a branch on two coarse resolutions leave no hope that a finer one reaches the compliance 1:
/// finer ones went on by a fifth, and by a few times the difference of the two.
bool is_hopeless(double coarse_end, double end) {
  return end > 0 && end * (1.2 + 6 * std::abs(1 - coarse_end / end)) < 1;
}

}  // namespace

ResolvedState follow_branch(const Problem& problem, const NewtonOptions& newton, const BranchObserver& observe,
                            Search search) {
  const std::size_t count = search == Search::quick ? ways_of_quick_search : meshes_on_the_way.size();
  ResolvedState state;
  double seen = 0;  // a resolution that starts anew need not show again what a coarser one showed
  const BranchObserver observe_new = [&](const Discretisation& space, const BranchState& branch) {
    if (branch.parameter > seen && observe) observe(space, branch);
    seen = std::max(seen, branch.parameter);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const bool last = i + 1 == meshes_on_the_way.size();
    const ContinuationOptions options = options_on_the_way(problem, newton, last, observe_new);
    ResolvedState next = enter(problem, options, state, meshes_on_the_way[i]);
    if (next.status == Status::converged) advance(problem, options, next);
    next.steps += state.steps;
    next.newton_iterations += state.newton_iterations;
    next.work += state.work;
    const double before = state.branch.parameter;
    const bool is_further = next.branch.tangent.size() > 0 && next.branch.parameter >= state.branch.parameter;
    if (is_further) {
      state = next;
    } else {
      state.status = next.status;
      state.newton_iterations = next.newton_iterations;
      state.work = next.work;
    }
    if (state.status == Status::converged || state.status == Status::stopped) break;
    // A surface that is unstable from the first load on is so at any resolution.
    const bool from_the_start = state.branch.parameter == 0 && state.status == Status::surface_unstable;
    state.gave_up =
        search == Search::hopeful && i > 0 && (from_the_start || is_hopeless(before, state.branch.parameter));
    if (state.gave_up) break;
  }
  return state;
}

ResolvedState at_resolution(const Problem& problem, const NewtonOptions& newton, const ResolvedState& from,
                            const Resolution& resolution) {
  ContinuationOptions options = options_on_the_way(problem, newton, true, {});
  options.newton.tolerance = newton.tolerance;
  ResolvedState coarse = from;
  ResolvedState state = enter(problem, options, coarse, resolution);
  if (state.status == Status::converged && state.branch.parameter < 1) advance(problem, options, state);
  return state;
}

}  // namespace rheocyte
