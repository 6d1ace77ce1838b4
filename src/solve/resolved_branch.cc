#include "solve/resolved_branch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solve/metered.h"
#include "solve/settle.h"
#include "solve/surface_stability.h"

namespace rheocyte {

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

}  // namespace

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
    const bool turns = next.status == Status::limit_point;  // seen finer it may do so earlier
    const bool is_found = next.status == Status::converged || turns || next.branch.tangent.size() > 0;
    if (is_found && (next.branch.parameter >= before || turns)) {
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
  if (search != Search::quick && !state.gave_up && state.branch.parameter > 0 && !is_nearly_unstable(state))
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
