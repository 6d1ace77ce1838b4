#include "solve/resolved_branch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solve/surface_stability.h"
#include "solve/warm_start.h"

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
  const auto& [parameter, unknowns, tangent, iterations] = state.branch;
  return unknowns.size() > 0 && state.discrete->stability_margin(problem_at(parameter), unknowns) < small_margin;
}

void ResolvedBranch::report(Discrete& discrete, const BranchState& state, double deformation) {
  seen_ = std::max(seen_, state.parameter);
  if (report_) report_({state.parameter, deformation, state.newton_iterations, discrete.resolution().degree});
}

ResolvedBranch::Accept ResolvedBranch::smooth() {
  return [this](Discrete& discrete, const BranchState& state) {
    const Problem here = problem_at(state.parameter);
    if (discrete.is_wrinkled(here, state.unknowns)) return false;
    // A way that begins anew need not show again what a coarser one showed.
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

ResolvedState ResolvedBranch::start(const Resolution& resolution, const ContinuationOptions& options,
                                    const Accept& accept) {
  ResolvedState state;
  state.discrete = discretise(resolution);
  const Metered metered(*this, state.discrete->system());
  take(start_branch(stiffness_path(state.discrete->system(), media_), with(options, accept, *state.discrete)), state);
  return state;
}

void ResolvedBranch::advance(ResolvedState& state, double compliance, const ContinuationOptions& options,
                             const Accept& accept) {
  const Metered metered(*this, state.discrete->system());
  Path path = stiffness_path(state.discrete->system(), media_);
  path.end = compliance;
  take(continue_branch(path, with(options, accept, *state.discrete), state.branch), state);
}

ResolvedState ResolvedBranch::solved(std::shared_ptr<Discrete> discrete, double compliance, VectorXd guess,
                                     const NewtonOptions& options) {
  ResolvedState state{.discrete = std::move(discrete), .branch = {compliance, std::move(guess), {}, 0}};
  const Metered metered(*this, state.discrete->system());
  const NewtonReport report = newton(state.discrete->system(), media_(compliance), options, state.branch.unknowns);
  state.status = report.status;
  state.residual = report.residual;
  state.branch.newton_iterations = report.iterations;
  statistics_.newton_iterations += report.iterations;
  return state;
}

ResolvedState ResolvedBranch::carried(const ResolvedState& from, const Resolution& resolution,
                                      const NewtonOptions& options) {
  const auto discrete = discretise(resolution);
  return solved(discrete, from.branch.parameter, discrete->transfer_from(*from.discrete, from.branch.unknowns),
                options);
}

/// The last state at another resolution, or the first state of the branch there if the last one does not hold: Newton
/// leaves it, or the finer surface is seen to be wrinkled. In the latter case it is forgotten (its compliance set to
/// 0).
ResolvedState ResolvedBranch::enter(ResolvedState& from, const Resolution& resolution,
                                    const ContinuationOptions& options, const NewtonOptions& across) {
  if (!from.discrete) return start(resolution, options, smooth());
  ResolvedState state = carried(from, resolution, across);
  if (state.status == Status::stopped) return state;
  if (state.status == Status::converged) {
    if (!is_wrinkled(state)) return state;
    from.branch.parameter = 0;
  }
  return start(resolution, options, smooth());
}

namespace {

/// So many tell how far the branch goes.
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
    const bool last = i + 1 == geometry_.ways.size(), is_guided = i > 0 && geometry_.ways[i - 1].is_scout;
    const ContinuationOptions way_options =
        options(last ? geometry_.min_step_at_last : geometry_.min_step_before_refining);
    ResolvedState next = enter(state, way.resolution, way_options, geometry_.across);
    if (next.status == Status::converged && next.branch.parameter < 1) advance(next, 1, way_options, smooth());
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
    if (state.gave_up) break;
  }
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

void ResolvedBranch::add(const ResolvedState& state, Ladder& ladder) const {
  ladder.add(state, state.discrete->numbers(problem_at(state.branch.parameter), state.branch.unknowns));
}

void ResolvedBranch::report_last(const Ladder& ladder) {
  const ResolvedState& last = ladder.rungs.back();
  report(*last.discrete, last.branch, ladder.deformation());
}

/// Where the gap is narrow the coarsest mesh is not trusted: neighbouring degrees agree there although both are wrong.
bool ResolvedBranch::is_accurate(const Ladder& ladder) const {
  if (ladder.rungs.size() < 2) return false;
  const Rungs& first = geometry_.rungs.front();
  if (first.only_begins && ladder.rungs.back().discrete->resolution().subdivision == first.subdivision) return false;
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
    if (!same_mesh && !rungs.goes_on) std::swap(ladder, before);
    const Status status = climb_on(rungs, state, ladder);
    if (ladder.rungs.empty()) std::swap(ladder, before);
    if (status == Status::converged || status == Status::stopped) return status;
    if (status == Status::surface_unstable || geometry_.rungs.size() == 1) reason = status;
  }
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
  }
  return Status::accuracy_not_reached;
}

Status ResolvedBranch::carry(const Problem& from, const Ladder& former, Ladder& ladder) {
  // Chord steps end just below the tolerance, where Newton's own end far below it: volumes were off by 3e-9.
  constexpr double of_chord_steps = 0.1;
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
