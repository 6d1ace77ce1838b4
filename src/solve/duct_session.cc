#include "solve/duct_session.h"

#include <utility>

#include "solve/duct_solver.h"
#include "solve/near_problem.h"
#include "solve/surface_stability.h"

namespace rheocyte {
namespace {

/// Settles the reason and says it in a sentence.
void explain(const Problem& problem, StationaryState& r) {
  Outcome& outcome = r.outcome;
  const bool failed = !has_state(outcome.status) && outcome.status != Status::stopped;
  const double margin = outcome.reached > 0 ? r.stability_margin : margin_at_rest(problem);
  if (failed && margin < small_margin) {
    outcome.status = Status::surface_unstable;
  } else if (outcome.status == Status::iteration_limit && outcome.reached > 0) {
    outcome.status = Status::branch_ended;
  }
  outcome.status = judged(outcome.status, {r.stability_margin, r.estimated_error, problem.accuracy});
  outcome.message = explanation(outcome, {.deformation = r.shape.deformation,
                                          .deformation_floor = r.deformation_floor,
                                          .estimated_error = r.estimated_error,
                                          .wanted_error = problem.accuracy,
                                          .stability_margin = r.stability_margin,
                                          .surface = surface_kind(problem),
                                          .can_bend = problem.offset == 0});
}

/// Whether the unknowns of both problems mean the same.
bool has_same_unknowns(const Problem& a, const Problem& b) {
  return has_same_laws(a, b) && distance(a, b) < max_change && subdivision_of(a) == subdivision_of(b) &&
         duct_layers_for(DuctGeometry(shape_of(a)), subdivision_of(a)) ==
             duct_layers_for(DuctGeometry(shape_of(b)), subdivision_of(b));
}

}  // namespace

struct DuctSession::Kept {
  Problem problem;
  DuctLadder ladder;

  std::size_t memory_bytes() const {
    std::size_t bytes = 0;
    for (const DuctState& rung : ladder.rungs) bytes += rung.discrete->system.memory_bytes();
    return bytes;
  }
};

DuctSession::DuctSession(std::size_t memory_limit_bytes) : memory_limit_(memory_limit_bytes) {}
DuctSession::~DuctSession() = default;
DuctSession::DuctSession(DuctSession&&) noexcept = default;
DuctSession& DuctSession::operator=(DuctSession&&) noexcept = default;

/// The kept ladder becomes the answer's; false if there is none near enough, or if it leads too far away. If a stop is
/// wanted, what was kept becomes what it was.
bool DuctSession::answer_nearby(DuctSolver& solver, Kept& answer, Status& status) {
  if (!kept_ || !has_same_unknowns(kept_->problem, answer.problem)) return false;
  const std::unique_ptr<Kept> from = std::exchange(kept_, nullptr);
  status = solver.carry(from->problem, from->ladder, answer.ladder);
  if (status == Status::converged) {
    ++warm_starts_;
    return true;
  }
  if (status == Status::stopped) {
    for (std::size_t i = 0; i < answer.ladder.rungs.size(); ++i) {
      DuctSystem &mine = from->ladder.rungs[i].discrete->system, &moved = answer.ladder.rungs[i].discrete->system;
      if (&mine != &moved) mine.exchange_factors(moved);
    }
    kept_ = std::make_unique<Kept>(std::move(*from));
  }
  answer.ladder = {.keeps_systems = answer.ladder.keeps_systems};
  return status == Status::stopped;
}

void DuctSession::solve(DuctSolver& solver, const Problem& problem, StationaryState& result) {
  Kept answer{problem, {.keeps_systems = memory_limit_ > 0}};
  Status& status = result.outcome.status;
  DuctState state;
  if (!answer_nearby(solver, answer, status)) {
    state = solver.follow();
    status = state.status;
  }
  if (status == Status::converged) status = solver.climb(state, answer.ladder);
  if (!answer.ladder.rungs.empty()) state = answer.ladder.rungs.back();
  if (state.discrete && state.branch.parameter > 0) {
    describe_duct(solver.problem_at(state.branch.parameter), *state.discrete, state.branch.unknowns, result);
    result.residual = state.residual;
    result.outcome.reached = state.branch.parameter;
  }
  // Stopped on the way to a higher degree the ladder is still good to begin from.
  if ((status == Status::converged || status == Status::stopped) && !answer.ladder.rungs.empty())
    keep(std::move(answer));
}

StationaryState DuctSession::solve(const Problem& problem, const ProgressCallback& progress,
                                   const std::atomic<bool>* stop) {
  StationaryState result;
  {
    const Stopwatch watch(result.statistics.total_s);
    result.shape = measure(Contour{});  // not a number until there is a shape
    DuctSolver solver(problem, softening(problem), progress, stop, result);
    solve(solver, problem, result);
    explain(problem, result);
  }
  return result;
}

std::size_t DuctSession::memory_bytes() const { return kept_ ? kept_->memory_bytes() : 0; }

void DuctSession::forget() { kept_.reset(); }

void DuctSession::keep(Kept answer) {
  if (memory_limit_ == 0) return;
  // The highest degrees are those whose factors are large: without them they are factorised anew.
  for (auto rung = answer.ladder.rungs.rbegin(); rung != answer.ladder.rungs.rend(); ++rung)
    if (answer.memory_bytes() > memory_limit_) rung->discrete->system.drop_factors();
  kept_ = std::make_unique<Kept>(std::move(answer));
}

}  // namespace rheocyte
