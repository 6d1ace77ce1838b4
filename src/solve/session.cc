#include "solve/session.h"

#include <algorithm>
#include <utility>

#include "solve/branch_ends.h"
#include "solve/equilibrium_offset.h"
#include "solve/resolved_branch.h"
#include "solve/sensitivity.h"
#include "solve/surface_stability.h"
#include "solve/warm_start.h"

namespace rheocyte {
namespace {

/// Settles the reason and says it in a sentence.
void explain(const Problem& problem, const Geometry& geometry, const ResolvedState& last, StationaryState& r) {
  Outcome& outcome = r.outcome;
  const bool failed_on_the_way = !has_state(outcome.status) && outcome.status != Status::stopped;
  const double margin = outcome.reached > 0 ? r.stability_margin : margin_at_rest(problem);
  const double least_margin = last.gave_up ? geometry.margin_at_coarse_ends : small_margin;
  if (failed_on_the_way && margin < least_margin) {
    outcome.status = Status::surface_unstable;
  } else if (outcome.status == Status::iteration_limit && outcome.reached > 0) {
    outcome.status = Status::branch_ended;
  }
  outcome.status = judged(outcome.status, {r.stability_margin, r.estimated_error, problem.accuracy});
  // The branch that was not followed to its end on a fine mesh ends later than it was seen to.
  const bool is_early =
      (last.gave_up && geometry.ends_late_on_finer) || (geometry.knows_ends && is_far_too_soft(problem));
  const auto known_end = is_early && geometry.knows_ends ? min_shear_modulus(problem) : std::nullopt;
  outcome.message = explanation(outcome, {.deformation = r.shape.deformation,
                                          .deformation_floor = r.deformation_floor,
                                          .estimated_error = r.estimated_error,
                                          .wanted_error = problem.accuracy,
                                          .stability_margin = r.stability_margin,
                                          .surface = surface_kind(problem),
                                          .weak_point = weak_point(problem, r.surface, least_margin),
                                          .can_bend = problem.offset == 0,
                                          .is_coarse = is_early,
                                          .known_end = known_end.value_or(0) / problem.bulk.shear_modulus,
                                          .turning = last.turning > 0 ? 1 / last.turning : 0});
}

/// To the end of the branch, which is known to lie before the problem.
ResolvedState follow_to_known_end(const Problem& problem, const Geometry& geometry, const ProgressCallback& report,
                                  const WorkLimits& limits, SolveStatistics& work) {
  const Problem target = at_end_of_branch(problem);
  const double fraction = problem.bulk.shear_modulus / target.bulk.shear_modulus;
  ResolvedBranch to_end(
      target, geometry,
      [&](BranchStep step) {
        step.compliance *= fraction;
        report(step);
      },
      limits);
  ResolvedState state = to_end.follow(Search::quick);
  work += to_end.take_statistics();
  state.branch.parameter *= fraction;
  if (state.status != Status::stopped) state.status = Status::surface_unstable;
  return state;
}

}  // namespace

/// If a stop is requested what was kept becomes what it was.
Status Session::answer_nearby(const Problem& problem, ResolvedBranch& branch, Ladder& answer) {
  const auto is_near = [&](const Kept& kept) {
    return has_same_laws(kept.problem, problem) && has_same_channel(kept.problem, problem) &&
           distance(kept.problem, problem) < max_change && branch.geometry().make == kept.make &&
           branch.geometry().is_alike(kept.problem, problem, kept.ladder.rungs.back().discrete->resolution());
  };
  const auto found = std::ranges::find_if(kept_, is_near);
  if (found == kept_.end()) return Status::not_started;
  Kept kept = std::move(*found);
  kept_.erase(found);
  const Status status = branch.carry(kept.problem, kept.ladder, answer);
  if (status == Status::converged) return ++warm_starts_, status;
  answer = {branch.geometry().errors};
  if (status != Status::stopped) return status;
  if (!has_same_mesh(kept.problem, problem))
    for (const ResolvedState& rung : kept.ladder.rungs) rung.discrete->move_to(kept.problem);
  keep(std::move(kept));
  return status;
}

StationaryState Session::solve(const Problem& problem, const ProgressCallback& progress, const WorkLimits& limits,
                               std::span<ProblemLine> lines) {
  const bool is_sought = is_duct(problem.section) && problem.place == CellPlace::equilibrium;
  if (!is_sought) return solve_in(solver_geometry(problem), problem, progress, limits, lines);
  for (ProblemLine& line : lines) line.clear();
  return solve_at_equilibrium(problem,
                              [&](const Problem& p) { return solve_in(solver_geometry(p), p, progress, limits); });
}

StationaryState Session::solve_in(const Geometry& geometry, const Problem& problem, const ProgressCallback& progress,
                                  const WorkLimits& limits, std::span<ProblemLine> lines) {
  StationaryState result;
  result.shape = measure(Contour{});  // not a number until there is a shape
  double total_s = 0;
  {
    const Stopwatch watch(total_s);
    const auto report = [&](const BranchStep& step) {
      result.branch.push_back(step);
      if (progress) progress(step);
    };
    ResolvedBranch branch(problem, geometry, report, limits);
    if (memory_limit_ > 0) branch.keep_factors();
    Kept answer{problem, geometry.make, {geometry.errors}};
    Ladder& ladder = answer.ladder;
    SolveStatistics work;
    ResolvedState state;
    Status& status = result.outcome.status;
    status = answer_nearby(problem, branch, ladder);
    if (status == Status::converged) {
      state = ladder.rungs.back();
    } else if (status != Status::stopped) {
      const bool ends_before = geometry.knows_ends && is_far_too_soft(problem);
      state = ends_before ? follow_to_known_end(problem, geometry, report, limits, work) : branch.follow();
      status = state.status;
    }
    if (status == Status::converged) status = branch.climb(state, ladder);
    work += branch.take_statistics();
    result.statistics = work;
    if (!ladder.rungs.empty()) {
      state = ladder.rungs.back();
      result.deformation_floor = deformation_floor(problem);
      result.estimated_error = ladder.stated_error(problem);
      result.errors = ladder.errors();
    }
    if (state.discrete && state.branch.parameter > 0) {
      state.discrete->describe(branch.problem_at(state.branch.parameter), state.branch.unknowns, result);
      result.residual = state.residual;
      result.outcome.reached = state.branch.parameter;
    }
    explain(problem, geometry, state, result);
    if (result.outcome.status == Status::converged && !lines.empty()) {
      follow_lines(geometry, problem, state, lines);
    } else {
      for (ProblemLine& line : lines) line.clear();
    }
    // Stopped on the way to a finer mesh the ladder is still good to begin from.
    const bool is_good = status == Status::converged || status == Status::stopped;
    if (is_good && !ladder.rungs.empty()) keep(std::move(answer));
  }
  result.statistics.total_s = total_s;
  return result;
}

std::size_t Session::Kept::memory_bytes() const {
  std::size_t bytes = 0;
  for (const ResolvedState& rung : ladder.rungs) bytes += rung.discrete->system().memory_bytes();
  return bytes;
}

std::size_t Session::memory_bytes() const {
  std::size_t bytes = 0;
  for (const Kept& kept : kept_) bytes += kept.memory_bytes();
  return bytes;
}

void Session::keep(Kept answer) {
  if (memory_limit_ == 0) return;
  kept_.push_front(std::move(answer));
  while (kept_.size() > 1 && memory_bytes() > memory_limit_) kept_.pop_back();
  // The highest degrees are those whose factors are large: without them they are factorised again.
  std::vector<ResolvedState>& rungs = kept_.front().ladder.rungs;
  for (auto rung = rungs.rbegin(); rung != rungs.rend() && memory_bytes() > memory_limit_; ++rung)
    rung->discrete->system().drop_factors();
  if (memory_bytes() > memory_limit_) kept_.clear();
}

}  // namespace rheocyte
