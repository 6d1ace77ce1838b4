#include "solve/session.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "fem/sample_fields.h"
#include "fem/write_fields.h"
#include "solve/branch_ends.h"
#include "solve/describe.h"
#include "solve/equilibrium_offset.h"
#include "solve/near_problem.h"

namespace rheocyte {
namespace {

constexpr double session_tolerance = 1e-10;

/// Of the surface's stability, where coarse resolutions lose the branch.
constexpr double margin_at_coarse_ends = 0.3;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void add_work(const ResolvedState& state, SolveStatistics& statistics) {
  statistics.newton_iterations += state.newton_iterations;
  statistics.continuation_steps += state.steps;
  statistics += state.work;
}

/// Whether the unknowns of both problems mean the same at any resolution.
bool is_alike(const Problem& a, const Problem& b, const Subdivision& subdivision) {
  return has_same_laws(a, b) && layers_for(ChannelGeometry(a.radius_ratio), subdivision) ==
                                    layers_for(ChannelGeometry(b.radius_ratio), subdivision);
}

/// Whether mesh and spaces differ.
bool is_elsewhere(const Problem& a, const Problem& b) {
  return a.radius_ratio != b.radius_ratio || a.liquid.exponent != b.liquid.exponent;
}

/// Carries a rung over; false if Newton fails or leads too far away.
bool move_rung(const Problem& from, const Problem& to, NewtonOptions options, ResolvedState& rung,
               SolveStatistics& statistics) {
  Discrete& discrete = *rung.discrete;
  if (is_elsewhere(from, to)) {
    discrete.move_to(to, rung.resolution);
    scale_displacement(discrete.space, to.radius_ratio / from.radius_ratio, rung.branch.unknowns);
  }
  const VectorXd before = rung.branch.unknowns;
  const WorkMeter work = discrete.system.work();
  options.keep_factors = true;
  const NewtonReport report = newton(discrete.system, to, options, rung.branch.unknowns);
  rung.residual = report.residual;
  statistics.newton_iterations += report.iterations;
  statistics += discrete.system.work() - work;
  return report.status == Status::converged &&
         stretch_change(discrete.space, before, rung.branch.unknowns) < max_stretch_change &&
         !is_wrinkled(to, discrete.space, rung.branch.unknowns);
}

void describe(const Problem& problem, const ResolvedState& state, StationaryState& r) {
  const Media media = media_at(problem, state.branch.parameter);
  describe_state(problem, {state.discrete, media, state.branch.unknowns}, r);
  // A mesh of its own: the session moves on.
  const auto with_space = [problem, resolution = state.resolution](const auto& use) {
    const ChannelMesh mesh(geometry_of(problem), resolution.subdivision);
    return use(Discretisation(mesh, resolution.degree, problem.liquid, interior_of(problem), problem.drive));
  };
  r.write_fields = [=, unknowns = state.branch.unknowns](const std::string& path, const Scales& scales) {
    return with_space([&](const Discretisation& space) { return write_fields(space, media, unknowns, scales, path); });
  };
  r.sample_fields = [=, unknowns = state.branch.unknowns](const Scales& scales, int points) {
    return with_space(
        [&](const Discretisation& space) { return sample_fields(space, media, unknowns, scales, points); });
  };
  r.residual = state.residual;
  r.outcome.reached = state.branch.parameter;
  if (state.branch.parameter < 1) {
    r.estimated_error = no_value;
    r.errors = unknown_numbers();
  }
  r.statistics.degree = state.resolution.degree;
}

/// Settles the reason and says it in a sentence.
void explain(const Problem& problem, const ResolvedState& state, StationaryState& r) {
  Outcome& outcome = r.outcome;
  const bool failed_on_the_way = !has_state(outcome.status) && outcome.status != Status::stopped;
  const double margin = state.gave_up ? margin_at_coarse_ends : small_margin;
  if (failed_on_the_way && state.discrete && r.stability_margin < margin) {
    outcome.status = Status::surface_unstable;
  } else if (outcome.status == Status::iteration_limit && state.branch.parameter > 0) {
    outcome.status = Status::branch_ended;
  }
  outcome.status = judged(outcome.status, {r.stability_margin, r.estimated_error, problem.accuracy});
  // The branch that was not followed to its end on a fine mesh ends later than it was seen to.
  const bool is_early = is_far_too_soft(problem) || state.gave_up;
  const double known_end = is_early ? min_shear_modulus(problem).value_or(0) / problem.bulk.shear_modulus : 0;
  outcome.message = explanation(outcome, {.deformation = r.shape.deformation,
                                          .deformation_floor = r.deformation_floor,
                                          .estimated_error = r.estimated_error,
                                          .wanted_error = problem.accuracy,
                                          .stability_margin = r.stability_margin,
                                          .surface = surface_kind(problem),
                                          .is_coarse = is_early,
                                          .known_end = known_end});
}

/// The branch from the sphere to the problem, or to the end of the branch where that is known to lie before.
ResolvedState follow_as_far_as_it_goes(const Problem& problem, const NewtonOptions& newton,
                                       const ProgressCallback& report) {
  const bool ends_before = is_far_too_soft(problem);
  const Problem target = ends_before ? at_end_of_branch(problem) : problem;
  const double share = problem.bulk.shear_modulus / target.bulk.shear_modulus;
  const BranchObserver observe = [&](const Discretisation& space, const BranchState& b) {
    const double compliance = ends_before ? share * b.parameter : b.parameter;
    report(
        {compliance, measure(contour(space, b.unknowns)).deformation, b.newton_iterations, space.reference().degree()});
  };
  ResolvedState state = follow_branch(target, newton, observe, ends_before ? Search::quick : Search::hopeful);
  if (ends_before) {
    state.branch.parameter *= share;
    if (state.status != Status::stopped) state.status = Status::surface_unstable;
  }
  return state;
}

}  // namespace

bool Session::answer_nearby(const Problem& problem, const NewtonOptions& newton, SolveStatistics& statistics,
                            Kept& answer) {
  const auto near = [&](const Kept& kept) {
    return is_alike(kept.problem, problem, kept.ladder.rungs.back().resolution.subdivision) &&
           distance(kept.problem, problem) < max_change;
  };
  const auto found = std::find_if(kept_.begin(), kept_.end(), near);
  if (found == kept_.end()) return false;
  Kept kept = std::move(*found);
  kept_.erase(found);
  answer.problem = problem;
  for (const ResolvedState& rung : kept.ladder.rungs) {
    ResolvedState moved = rung;
    if (!move_rung(kept.problem, problem, newton, moved, statistics)) {
      if (newton.stop && *newton.stop) take_back(std::move(kept), problem);
      return false;
    }
    answer.ladder.add(problem, std::move(moved));
    if (is_accurate(answer.ladder, problem)) break;
  }
  return true;
}

void Session::take_back(Kept kept, const Problem& from) {
  if (is_elsewhere(from, kept.problem))
    for (const ResolvedState& rung : kept.ladder.rungs) rung.discrete->move_to(kept.problem, rung.resolution);
  keep(std::move(kept));
}

StationaryState Session::solve(const Problem& problem, const ProgressCallback& progress,
                               const std::atomic<bool>* stop) {
  if (is_duct(problem.section)) {
    const SolveAtOffset solve = [&](const Problem& p) { return ducts_.solve(p, progress, stop); };
    StationaryState state =
        problem.place == CellPlace::equilibrium ? solve_at_equilibrium(problem, solve) : solve(problem);
    forget_tubes();
    return state;
  }
  const auto start = std::chrono::steady_clock::now();
  StationaryState result;
  result.shape = measure(Contour{});  // not a number until there is a shape
  const NewtonOptions newton{.tolerance = session_tolerance, .stop = stop};
  const auto report = [&](const BranchStep& point) {
    result.branch.push_back(point);
    if (progress) progress(point);
  };
  const RungObserver on_rung = [&](const ResolvedState& state, const Ladder* ladder) {
    add_work(state, result.statistics);
    if (ladder)
      report({state.branch.parameter, ladder->deformations.back(), state.newton_iterations, state.resolution.degree});
  };

  Kept answer{problem, {.keeps_systems = memory_limit_ > 0}};
  ResolvedState state;
  if (answer_nearby(problem, newton, result.statistics, answer)) {
    ++warm_starts_;
    state = answer.ladder.rungs.back();
    report({1, answer.ladder.deformations.back(), result.statistics.newton_iterations, state.resolution.degree});
  } else {
    answer.ladder = {.keeps_systems = memory_limit_ > 0};
    state = follow_as_far_as_it_goes(problem, newton, report);
    add_work(state, result.statistics);
  }
  result.outcome.status = state.status;
  if (state.status == Status::converged && !is_accurate(answer.ladder, problem)) {
    const Ladder before = answer.ladder;
    result.outcome.status = climb(problem, newton, state, answer.ladder, on_rung);
    if (answer.ladder.rungs.empty()) answer.ladder = before;
  }
  if (!answer.ladder.rungs.empty()) {
    state = answer.ladder.rungs.back();
    result.deformation_floor = deformation_floor(problem);
    result.estimated_error = stated_error(problem, answer.ladder.estimated_error, answer.ladder.deformations.back());
    result.errors = answer.ladder.errors();
  }
  if (state.discrete && state.branch.parameter > 0) describe(problem, state, result);
  explain(problem, state, result);
  // Stopped on the way to a finer mesh the ladder is still good to begin from.
  const bool is_good = result.outcome.status == Status::converged || result.outcome.status == Status::stopped;
  if (is_good && !answer.ladder.rungs.empty()) keep(std::move(answer));
  result.statistics.total_s = seconds_since(start);
  return result;
}

std::size_t Session::memory_bytes() const {
  std::size_t bytes = ducts_.memory_bytes();
  for (const Kept& kept : kept_) {
    for (const ResolvedState& rung : kept.ladder.rungs) bytes += rung.discrete->system.memory_bytes();
  }
  return bytes;
}

void Session::keep(Kept answer) {
  if (memory_limit_ == 0) return;
  kept_.push_front(std::move(answer));
  if (memory_bytes() > memory_limit_) ducts_.forget();
  forget_tubes();
}

void Session::forget_tubes() {
  while (!kept_.empty() && memory_bytes() > memory_limit_) kept_.pop_back();
}

}  // namespace rheocyte
