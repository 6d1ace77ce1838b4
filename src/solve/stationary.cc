#include "solve/stationary.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>

#include "solve/describe.h"
#include "solve/resolved_branch.h"

namespace rheocyte {
namespace {

/// Finest degree on each mesh of the ladder, coarse to fine.
struct Rung {
  Subdivision subdivision;
  int first_degree, last_degree;
};
constexpr std::array<Rung, 3> ladder = {{{{2, 4, 1, 2}, 4, 9}, {{3, 6, 1, 2}, 7, 10}, {{4, 8, 2, 2}, 7, 10}}};
constexpr double final_tolerance = 1e-10;
/// Of the deformation, absolute: what area and perimeter leave of it after their digits cancel.
constexpr double round_off = 1e-12, tiny_deformation = 1e-5;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double deformation(const Discretisation& space, const VectorXd& unknowns) {
  return measure(contour(space, unknowns)).deformation;
}

/// No first change is trusted below this: neighbouring degrees may agree by chance.
constexpr double least_first_estimate = 2e-5;

/// Error of the last of some values of the deformation on ever finer resolutions, relative to it
/// (docs/theory.md, eq:error): the last change times the rest of a geometric series, and half of the last two changes
/// at least.
double estimate_error(const std::vector<double>& values) {
  const std::size_t n = values.size();
  if (n < 2) return std::numeric_limits<double>::infinity();
  const double change = values[n - 1] - values[n - 2], size = std::max(std::abs(values[n - 1]), 1e-300);
  if (n == 2) return std::max(2 * std::abs(change) / size, least_first_estimate);
  const double before = values[n - 2] - values[n - 3];
  const double ratio = before == 0 ? 0 : std::min(change / before, 0.9);
  const double share = ratio < 0 ? 1 : std::max(0.5, ratio / (1 - ratio));  // below 0: changes of alternating sign
  return std::max(share * std::abs(change), 0.5 * std::abs(before)) / size;
}

/// Adds up the work of systems that come and go.
class Tally {
 public:
  explicit Tally(SolveStatistics& statistics) : statistics_(statistics) {}
  void add(const ResolvedState& state) {
    statistics_.newton_iterations += state.newton_iterations;
    statistics_.continuation_steps += state.steps;
    statistics_.factorisations += state.work.factorisations;
    statistics_.assembly_s += state.work.assembly_s;
    statistics_.factorisation_s += state.work.condensation_s + state.work.sparse_s;
    statistics_.substitution_s += state.work.solve_s;
  }

 private:
  SolveStatistics& statistics_;
};

class StationarySolver {
 public:
  StationarySolver(const Problem& problem, const ProgressCallback& progress, const std::atomic<bool>* stop)
      : problem_(problem), progress_(progress) {
    newton_.stop = stop;
    newton_.tolerance = final_tolerance;
  }

  StationaryState solve() {
    const auto start = std::chrono::steady_clock::now();
    result_.shape = measure(Contour{});  // not a number until there is a shape
    Tally tally(result_.statistics);
    ResolvedState state = follow_branch(problem_, newton_, [this](const Discretisation& space, const BranchState& b) {
      report({b.parameter, deformation(space, b.unknowns), b.newton_iterations, space.reference().degree()});
    });
    tally.add(state);
    if (state.status == Status::converged) state = climb(state, tally);
    result_.outcome.status = state.status;
    if (state.discrete && state.branch.parameter > 0) describe(state);
    explain(state);
    result_.statistics.total_s = seconds_since(start);
    return std::move(result_);
  }

 private:
  void report(const BranchStep& point) {
    result_.branch.push_back(point);
    if (progress_) progress_(point);
  }

  /// Raises degree and mesh until the estimated error is below the wanted one.
  ResolvedState climb(ResolvedState state, Tally& tally) {
    Status reason = Status::accuracy_not_reached;
    for (const Rung& rung : ladder) {
      if (rung.subdivision.top < state.resolution.subdivision.top) continue;
      std::vector<double> values;  // of this mesh alone: a new mesh at a lower degree need not be better at once
      for (int degree = rung.first_degree; degree <= rung.last_degree; ++degree) {
        const bool same_mesh = rung.subdivision.top == state.resolution.subdivision.top;
        if (same_mesh && degree < state.resolution.degree) continue;
        const ResolvedState next = at_resolution(problem_, newton_, state, {rung.subdivision, degree});
        tally.add(next);
        if (next.status == Status::stopped) return state.status = Status::stopped, state;
        if (next.status != Status::converged || is_wrinkled(problem_, next.discrete->space, next.branch.unknowns)) {
          if (next.branch.unknowns.size() > 0 &&
              stability_margin(problem_, next.discrete->space, next.branch.unknowns) < small_margin)
            reason = Status::surface_unstable;
          break;  // this mesh cannot hold the state: the next one
        }
        state = next;
        values.push_back(deformation(state.discrete->space, state.branch.unknowns));
        result_.estimated_error = estimate_error(values);
        report({state.branch.parameter, values.back(), state.newton_iterations, degree});
        if (values.size() >= 2 && is_accurate(values.back())) return state;
      }
    }
    state.status = reason;
    return state;
  }

  /// Whether the estimated error is below the wanted one, or below what can be resolved of a tiny deformation.
  bool is_accurate(double value) const {
    const double size = std::abs(value), error = result_.estimated_error;
    return error <= problem_.accuracy || (size < tiny_deformation && error * size <= round_off);
  }

  void describe(const ResolvedState& state) {
    StationaryState& r = result_;
    const auto& [parameter, unknowns, tangent, iterations] = state.branch;
    describe_state(problem_, {state.discrete, media_at(problem_, parameter), unknowns}, r);
    r.residual = state.residual;
    r.outcome.reached = parameter;
    if (parameter < 1) r.estimated_error = std::numeric_limits<double>::quiet_NaN();
    r.statistics.degree = state.resolution.degree;
  }

  /// Settles the reason and says it in a sentence.
  void explain(const ResolvedState& state) {
    Outcome& outcome = result_.outcome;
    const bool failed_on_the_way = outcome.status != Status::converged && outcome.status != Status::stopped &&
                                   outcome.status != Status::accuracy_not_reached;
    if (failed_on_the_way && state.discrete && result_.stability_margin < small_margin) {
      outcome.status = Status::surface_unstable;
    } else if (outcome.status == Status::iteration_limit && state.branch.parameter > 0) {
      outcome.status = Status::branch_ended;
    }
    outcome.message =
        explanation(outcome, {result_.shape.deformation, result_.estimated_error, surface_kind(problem_)});
  }

  Problem problem_;
  ProgressCallback progress_;
  NewtonOptions newton_;
  StationaryState result_;
};

}  // namespace

StationaryState solve_stationary(const Problem& problem, const ProgressCallback& progress,
                                 const std::atomic<bool>* stop) {
  return StationarySolver(problem, progress, stop).solve();
}

}  // namespace rheocyte
