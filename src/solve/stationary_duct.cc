#include "solve/stationary_duct.h"

#include <array>
#include <cmath>

#include "solve/continuation.h"
#include "solve/describe_duct.h"
#include "solve/ladder.h"
#include "solve/surface_stability.h"

namespace rheocyte {
namespace {

/// Degrees of the way along the branch, and of the ladder that ends it, on one mesh.
constexpr std::array ways = {3, 4, 5};
constexpr int first_degree = 3, last_degree = 7;
constexpr double tolerance_on_the_way = 1e-7, final_tolerance = 1e-9;
constexpr double least_step_before_refining = 0.03, least_step_at_last = 5e-3;

/// Higher degrees move the end of a branch by a few per cent: where it is farther from the wanted compliance than this,
/// they are not tried.
constexpr double hopeful_share = 0.85;

/// A degree more costs three times as much here, and less caution than in the tube has to do (eq:square-error).
constexpr double share_of_change_before = 0.1;

/// A state, how it was resolved, and how the way to it ended.
struct DuctState {
  Status status = Status::not_started;
  std::shared_ptr<DuctDiscrete> discrete;
  BranchState branch;
  double residual = 0;
};

/// One case on its way.
class DuctSolver {
 public:
  DuctSolver(const Problem& problem, const ProgressCallback& progress, const std::atomic<bool>* stop,
             StationaryState& result)
      : problem_(problem), progress_(progress), stop_(stop), result_(result) {}

  /// From the sphere to the wanted compliance, or as far as the branch goes.
  DuctState follow() {
    DuctState state;
    for (const int degree : ways) {
      DuctState next = enter(state, degree);
      if (next.status == Status::converged && next.branch.parameter < 1) advance(next, degree == ways.back());
      if (next.branch.unknowns.size() > 0 && next.branch.parameter >= state.branch.parameter) {
        state = std::move(next);
      } else {
        state.status = next.status;
      }
      if (state.status == Status::converged || state.status == Status::stopped) break;
      if (state.branch.parameter > 0 && state.branch.parameter < hopeful_share) break;
    }
    return state;
  }

  /// Raises the degree until the error is small.
  Status climb(DuctState& state) {
    std::vector<double> deformations;
    for (int degree = std::max(first_degree, state.discrete->space.reference().degree()); degree <= last_degree;
         ++degree) {
      if (degree > state.discrete->space.reference().degree()) {
        DuctState next = at_degree(state, degree, {.tolerance = final_tolerance, .stop = stop_});
        if (next.status != Status::converged) return next.status;
        state = std::move(next);
      }
      deformations.push_back(duct_deformation(state.discrete->space, state.branch.unknowns, problem_.camera));
      report(state.branch, deformations.back(), degree);
      result_.estimated_error = estimate_error(deformations, share_of_change_before);
      if (result_.estimated_error <= problem_.accuracy) return Status::converged;
    }
    return Status::accuracy_not_reached;
  }

 private:
  ContinuationOptions options(bool last) {
    ContinuationOptions options;
    options.newton = {.tolerance = tolerance_on_the_way, .iteration_limit = 6, .stop = stop_};
    options.least_step = last ? least_step_at_last : least_step_before_refining;
    options.accept = [this](const NonlinearSystem& system, const BranchState& state) {
      const DuctSpace& space = static_cast<const DuctSystem&>(system).space();
      if (duct_stability_margin(space, state.unknowns) < 0) return false;
      report(state, duct_deformation(space, state.unknowns, problem_.camera), space.reference().degree());
      return true;
    };
    return options;
  }

  /// The last state at a higher degree, or the first state of the branch.
  DuctState enter(const DuctState& from, int degree) {
    if (from.discrete) return at_degree(from, degree, {.tolerance = tolerance_on_the_way, .stop = stop_});
    DuctState state;
    state.discrete = std::make_shared<DuctDiscrete>(problem_, DuctSubdivision{}, degree);
    take(state, start_branch(state.discrete->system, problem_, options(false)));
    count(state.discrete->system.work());
    return state;
  }

  void advance(DuctState& state, bool last) {
    const WorkMeter before = state.discrete->system.work();
    take(state, continue_branch(stiffness_path(state.discrete->system, problem_), options(last), state.branch));
    count(state.discrete->system.work() - before);
  }

  DuctState at_degree(const DuctState& from, int degree, const NewtonOptions& options) {
    DuctState to;
    to.discrete = std::make_shared<DuctDiscrete>(problem_, DuctSubdivision{}, degree);
    to.branch.parameter = from.branch.parameter;
    to.branch.unknowns = transfer(from.discrete->space, from.branch.unknowns, to.discrete->space);
    const NewtonReport report =
        newton(to.discrete->system, media_at(problem_, to.branch.parameter), options, to.branch.unknowns);
    to.status = report.status;
    to.residual = report.residual;
    to.branch.newton_iterations = report.iterations;
    result_.statistics.newton_iterations += report.iterations;
    count(to.discrete->system.work());
    return to;
  }

  void take(DuctState& state, const ContinuationReport& report) {
    state.status = report.status;
    state.branch = report.last;
    state.residual = report.residual;
    result_.statistics.newton_iterations += report.newton_iterations;
    result_.statistics.continuation_steps += report.steps;
  }

  void count(const WorkMeter& work) {
    SolveStatistics& statistics = result_.statistics;
    statistics.factorisations += work.factorisations;
    statistics.assembly_s += work.assembly_s;
    statistics.factorisation_s += work.condensation_s + work.sparse_s;
    statistics.substitution_s += work.solve_s;
  }

  void report(const BranchState& state, double deformation, int degree) {
    result_.branch.push_back({state.parameter, deformation, state.newton_iterations, degree});
    if (progress_) progress_(result_.branch.back());
  }

  const Problem& problem_;
  const ProgressCallback& progress_;
  const std::atomic<bool>* stop_;
  StationaryState& result_;
};

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
