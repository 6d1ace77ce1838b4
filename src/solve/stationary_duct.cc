#include "solve/stationary_duct.h"

#include "solve/duct_solver.h"
#include "solve/surface_stability.h"

namespace rheocyte {
namespace {

/// Settles the reason and says it in a sentence.
void explain(const Problem& problem, StationaryState& r) {
  Outcome& outcome = r.outcome;
  const bool failed = outcome.status != Status::converged && outcome.status != Status::stopped &&
                      outcome.status != Status::accuracy_not_reached;
  if (failed && r.stability_margin < small_margin) {
    outcome.status = Status::surface_unstable;
  } else if (outcome.status == Status::iteration_limit && outcome.reached > 0) {
    outcome.status = Status::branch_ended;
  }
  outcome.message =
      explanation(outcome, {r.shape.deformation, r.estimated_error, problem.accuracy, surface_kind(problem), 0});
}

}  // namespace

StationaryState solve_in_duct(const Problem& problem, const ProgressCallback& progress, const std::atomic<bool>* stop) {
  StationaryState result;
  {
    const Stopwatch watch(result.statistics.total_s);
    result.shape = measure(Contour{});  // not a number until there is a shape
    DuctSolver solver(problem, progress, stop, result);
    DuctState state = solver.follow();
    result.outcome.status = state.status;
    if (state.status == Status::converged) result.outcome.status = solver.climb(state);
    if (state.discrete && state.branch.parameter > 0) {
      const Media media = media_at(problem, state.branch.parameter);
      describe_duct(problem, media, state.discrete, state.branch.unknowns, result);
      result.residual = state.residual;
      result.outcome.reached = state.branch.parameter;
    }
    explain(problem, result);
  }
  return result;
}

}  // namespace rheocyte
