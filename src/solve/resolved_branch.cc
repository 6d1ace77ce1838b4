#include "solve/resolved_branch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solve/arclength.h"
#include "solve/fit_on_the_way.h"
#include "solve/settle.h"
#include "solve/surface_stability.h"

namespace rheocyte {

/// While it lives, what a system works is counted, and the system gives up its work once it is to stop.
class ResolvedBranch::Metered {
 public:
  Metered(ResolvedBranch& branch, NonlinearSystem& system) : branch_(branch), system_(system), before_(system.work()) {
    system_.obey(branch.limits_);
  }
  ~Metered() {
    system_.obey({});
    branch_.statistics_ += system_.work() - before_;
  }
  Metered(const Metered&) = delete;
  Metered& operator=(const Metered&) = delete;

 private:
  ResolvedBranch& branch_;
  NonlinearSystem& system_;
  WorkMeter before_;
};

ResolvedBranch::ResolvedBranch(const Problem& problem, MediaAt media, Geometry geometry, ProgressCallback report,
                               const WorkLimits& limits)
    : problem_(problem),
      media_(std::move(media)),
      geometry_(std::move(geometry)),
      report_(std::move(report)),
      limits_(limits) {
  for (NewtonOptions* options : {&geometry_.along, &geometry_.across, &geometry_.fine}) options->stop = limits.stop;
}

std::shared_ptr<Discrete> ResolvedBranch::discretise(const Resolution& resolution) {
  const auto known = std::ranges::find(made_, resolution, [](const auto& made) { return made->resolution(); });
  if (known != made_.end()) return *known;
  auto made = geometry_.make(problem_, resolution);
  made_.push_back(made);
  return made;
}

bool ResolvedBranch::is_wrinkled(const ResolvedState& state) const {
  return state.discrete->is_wrinkled(problem_at(state.branch.parameter), state.branch.unknowns);
}

/// Whether the surface is so near its limit that no mesh can hold the state.
bool ResolvedBranch::is_nearly_unstable(const ResolvedState& state) const {
  const VectorXd& unknowns = state.branch.unknowns;
  return unknowns.size() > 0 &&
         state.discrete->stability_margin(problem_at(state.branch.parameter), unknowns) < small_margin;
}

/// Whether the way has ended because the next state's cortex resists compression no more: finer meshes see the same.
bool ResolvedBranch::has_collapsed(const ResolvedState& state) const {
  return state.status == Status::surface_unstable && surface_kind(problem_) == SurfaceKind::held &&
         is_nearly_unstable(state);
}

void ResolvedBranch::report(Discrete& discrete, const BranchState& state, double deformation) {
  seen_ = std::max(seen_, state.parameter);
  if (report_) report_({state.parameter, deformation, state.newton_iterations, discrete.resolution().degree});
}

ResolvedBranch::Accept ResolvedBranch::smooth() {
  return [this](Discrete& discrete, const BranchState& state) {
    const Problem here = problem_at(state.parameter);
    if (discrete.is_wrinkled(here, state.unknowns)) return false;
    trail_.push_back({.status = Status::converged, .discrete = discrete.shared_from_this(), .branch = state});
    // A way that starts again need not show again what a coarser one showed.
    if (report_ && state.parameter > seen_) report(discrete, state, discrete.deformation(here, state.unknowns));
    return true;
  };
}

ContinuationOptions ResolvedBranch::options(double min_step) const {
  ContinuationOptions options;
  options.newton = geometry_.along;
  options.min_step = min_step;
  return options;
}

namespace {

ContinuationOptions with(ContinuationOptions options, const ResolvedBranch::Accept& accept, Discrete& discrete) {
  if (accept)
    options.accept = [&](const NonlinearSystem&, const BranchState& state) { return accept(discrete, state); };
  return options;
}

}  // namespace

void ResolvedBranch::take(const ContinuationReport& report, ResolvedState& state) {
  state.status = report.status;
  state.branch = report.last;
  state.residual = report.residual;
  statistics_.newton_iterations += report.newton_iterations;
  statistics_.continuation_steps += report.steps;
}

/// Of the compliance, between two ends of a way at which its mesh is fitted: near a fold fits gain ever less.
constexpr double least_gain_by_fit = 5e-3;

/// Where a state is carried to another resolution: so far back from the last one, and farther.
constexpr double steps_back[] = {1, 0.92, 0.8};

ResolvedState ResolvedBranch::start(const Resolution& resolution, const ContinuationOptions& options,
                                    const Accept& accept) {
  ResolvedState state;
  state.discrete = discretise(resolution);
  const Metered metered(*this, state.discrete->system());
  take(start_branch(stiffness_path(state.discrete->system(), media_), with(options, accept, *state.discrete)), state);
  return state;
}

WayPoint ResolvedBranch::go(ResolvedState& state, double compliance, const ContinuationOptions& options,
                            const Accept& accept, bool pauses) {
  Discrete& discrete = *state.discrete;
  const Metered metered(*this, discrete.system());
  Path path = stiffness_path(discrete.system(), media_);
  path.end = compliance;
  ContinuationOptions here = with(options, accept, discrete);
  if (pauses) here.pause = [&](const BranchState& found) { return discrete.is_worn(found.unknowns); };
  take(continue_branch(path, here, state.branch), state);
  return WayPoint{state.status, state.branch.parameter};
}

void ResolvedBranch::advance(ResolvedState& state, double compliance, const ContinuationOptions& options,
                             const Accept& accept, Fits fits) {
  const auto go_on = [&](bool pauses) { return go(state, compliance, options, accept, pauses); };
  const auto fit_here = [&] { return fit(state, options.newton); };
  if (fits == Fits::ever_again) return fit_on_the_way(compliance, go_on, fit_here);
  const auto is_worn = [&](const WayPoint& here) {
    return here.status == Status::converged && here.parameter < compliance;
  };
  WayPoint here = go_on(true);
  if (is_worn(here) && !state.discrete->is_fitted() && fit_here()) here = go_on(true);
  if (is_worn(here)) state.status = Status::mesh_folded;
}

bool ResolvedBranch::fit(ResolvedState& state, NewtonOptions options) {
  options.iteration_limit = geometry_.across.iteration_limit;  // the mesh changes as from one way to the next
  const auto before = state.discrete;
  return before->try_fitted(state.branch.unknowns, [&](const std::shared_ptr<Discrete>& discrete, VectorXd guess) {
    if (is_stopped()) return false;
    ResolvedState found = solved(discrete, state.branch.parameter, std::move(guess), options, newton_or_settle);
    if (found.status != Status::converged || is_wrinkled(found)) return false;
    before->system().drop_factors();  // the trail keeps it
    found.branch.step = state.branch.step;
    found.branch.aim = state.branch.aim;
    state = std::move(found);
    return true;
  });
}

ResolvedState ResolvedBranch::solved(std::shared_ptr<Discrete> discrete, double compliance, VectorXd guess,
                                     const NewtonOptions& options, FindState find) {
  ResolvedState state{.discrete = std::move(discrete), .branch = {compliance, std::move(guess), {}, 0}};
  const Metered metered(*this, state.discrete->system());
  const NewtonReport report = find(state.discrete->system(), media_(compliance), options, state.branch.unknowns);
  state.status = report.status;
  state.residual = report.residual;
  state.branch.newton_iterations = report.iterations;
  statistics_.newton_iterations += report.iterations;
  return state;
}

ResolvedState ResolvedBranch::carried(const ResolvedState& from, const Resolution& resolution,
                                      const NewtonOptions& options) {
  auto discrete = discretise(resolution);
  if (const auto fitted = discrete->fitted_as(*from.discrete)) discrete = fitted;
  VectorXd guess = discrete->transfer_from(*from.discrete, from.branch.unknowns);
  if (discrete->is_worn(guess))
    if (const auto fitted = discrete->fitted(guess, 1)) {
      guess = fitted->carry_from(*discrete, guess);
      discrete = fitted;
    }
  ResolvedState found = solved(discrete, from.branch.parameter, guess, options, newton_or_settle);
  if (found.status == Status::converged || found.status == Status::stopped) return found;
  // Elements that fit the surface otherwise may do.
  const auto even = discrete->is_fitted() ? discrete->fitted(guess, 1, 0) : nullptr;
  if (!even) return found;
  return solved(even, from.branch.parameter, even->carry_from(*discrete, guess), options, newton_or_settle);
}

/// A state at another resolution: the last one, or one before it that Newton does not leave there; or the first one of
/// the branch if there is none such, or the finer surface is seen to be wrinkled. In the latter case the last one is
/// forgotten (its compliance set to 0).
ResolvedState ResolvedBranch::enter(ResolvedState& from, const Resolution& resolution,
                                    const ContinuationOptions& options, const NewtonOptions& across) {
  if (!from.discrete) return start(resolution, options, smooth());
  for (const double fraction : steps_back) {
    // Where a mesh is worn its states are far from those of the next one, and another mesh turns elsewhere.
    if (from.status == Status::mesh_folded && fraction > std::ranges::min(steps_back)) continue;
    if (from.status == Status::limit_point && fraction == 1) continue;
    const double farthest = fraction * from.branch.parameter;
    const auto before = std::find_if(trail_.rbegin(), trail_.rend(), [&](const ResolvedState& passed) {
      return passed.discrete->resolution() == from.discrete->resolution() && passed.branch.parameter <= farthest;
    });
    if (fraction < 1 && before == trail_.rend()) break;
    ResolvedState state = carried(fraction < 1 ? *before : from, resolution, across);
    if (state.status == Status::stopped) return state;
    if (state.status != Status::converged) continue;
    if (!is_wrinkled(state)) return trail_.push_back(state), state;
    from.branch.parameter = 0;
    break;
  }
  return start(resolution, options, smooth());
}

namespace {

/// So many show how far the branch goes.
constexpr std::size_t coarse_ways = 2;

/// Whether the ends of a branch on two coarse resolutions leave no hope that a finer one reaches the compliance 1.
bool is_hopeless(const Geometry& geometry, double coarse_end, double end) {
  const double change = geometry.gain_by_change > 0 ? geometry.gain_by_change * std::abs(1 - coarse_end / end) : 0;
  return end > 0 && end * (geometry.gain_of_finer + change) < 1;
}

/// Where a way ends: of Newton's failures, any.
bool is_unexplained(Status status) {
  return status == Status::iteration_limit || status == Status::branch_ended || status == Status::mesh_folded ||
         status == Status::singular_matrix;
}

/// So often the mesh is fitted where a branch is traced.
constexpr int max_traces = 6;

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
    state.branch.tangent = {};
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
  for (int i = 0; i < max_traces && !is_stopped(); ++i) {
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

ResolvedState ResolvedBranch::follow(Search search) {
  ResolvedState state;
  const std::size_t count = search == Search::quick ? coarse_ways : geometry_.ways.size();
  for (std::size_t i = 0; i < count; ++i) {
    const CoarseWay& way = geometry_.ways[i];
    if (way.fits == Fits::once && state.status == Status::mesh_folded) continue;
    const bool last = i + 1 == geometry_.ways.size(), is_guided = i > 0 && geometry_.ways[i - 1].is_scout;
    const ContinuationOptions way_options =
        options(last ? geometry_.min_step_at_last : geometry_.min_step_before_refining);
    ResolvedState next = enter(state, way.resolution, way_options, geometry_.across);
    if (next.status == Status::converged && next.branch.parameter < 1) go_on(next, way, way_options);
    const double before = is_guided ? 0 : state.branch.parameter;
    const bool is_found = next.status == Status::converged || next.branch.tangent.size() > 0;
    if (is_found && next.branch.parameter >= before) {
      state = std::move(next);
    } else {
      if (is_guided && next.status != Status::stopped) state = {};
      state.status = next.status;
    }
    if (state.status == Status::stopped) break;
    if (way.is_scout) {
      if (state.status != Status::converged) state = {};
      continue;
    }
    if (state.status == Status::converged) break;
    if (search != Search::hopeful || i + 1 < coarse_ways) continue;
    // A surface that is unstable from the first load on is so at any resolution.
    const bool from_the_start = state.branch.parameter == 0 && state.status == Status::surface_unstable;
    state.gave_up = from_the_start || is_hopeless(geometry_, before, state.branch.parameter);
    if (state.gave_up || has_collapsed(state)) break;
  }
  if (search != Search::quick && !state.gave_up && state.branch.parameter > 0 && is_unexplained(state.status) &&
      !is_nearly_unstable(state))
    look_beyond(state, options(geometry_.min_step_at_last));
  return state;
}

ResolvedState ResolvedBranch::at_resolution(const ResolvedState& from, const Resolution& resolution) {
  if (!geometry_.climbs_anew) return carried(from, resolution, geometry_.fine);
  ContinuationOptions finely = options(geometry_.min_step_at_last);
  finely.newton.tolerance = geometry_.fine.tolerance;
  ResolvedState coarse = from;
  ResolvedState state = enter(coarse, resolution, finely, geometry_.fine);
  if (state.status == Status::converged && state.branch.parameter < 1) advance(state, 1, finely, smooth());
  return state;
}

}  // namespace rheocyte
