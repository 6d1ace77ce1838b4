#include "solve/duct_solver.h"

#include <algorithm>
#include <array>

#include "solve/ladder.h"
#include "solve/near_problem.h"

namespace rheocyte {
namespace {

/// Degrees of the way along the branch, where the scout's does not lead to its end.
constexpr std::array ways = {3, 4, 5};
/// A tangent takes a third of the time that it takes at the first of the ways.
constexpr int degree_of_scout = 2;
constexpr double tolerance_on_the_way = 1e-7;
constexpr double min_step_before_refining = 0.03, min_step_at_last = 5e-3;

/// Higher degrees move the end of a branch by a few per cent: where it is farther from the wanted compliance than this,
/// they are not tried.
constexpr double hopeful_share = 0.85;

/// A degree more costs three times as much here, and less caution than in the tube has to do (eq:square-error).
constexpr double share_of_change_before = 0.1;
/// Degrees 3 and 4 may agree by chance, while the latter's error is up to 1e-3.
constexpr double min_error_of_two_rungs = 6e-4;
/// So may they in the other numbers, which are more accurate.
constexpr double min_share_of_two_rungs = 2e-4;

/// A drift is told from none down to this.
constexpr double share_of_velocity = 1e-4;

/// The half of a cell off the axis has four times the unknowns of the eighth.
constexpr int last_degree_off_axis = 6;
int last_degree_of(const Problem& problem) {
  return problem.offset == 0 ? DuctSolver::last_degree : last_degree_off_axis;
}

/// A deformation changes by about as much, relative, as the residual that is left: far less than the wanted accuracy. A
/// factorisation costs as much as tens of chord steps at high degrees. From one degree to the next, or to a nearby
/// case, a state takes one to three; beyond the end of the branch Newton wanders. Off the axis it takes more in
/// strongly shear-thinning liquids, whose viscosity is the least smooth where the cell no longer covers the axis.
NewtonOptions fine_newton(const Problem& problem, const std::atomic<bool>* stop) {
  return {.tolerance = std::min(1e-8, 1e-5 * problem.accuracy),
          .iteration_limit = problem.offset == 0 ? 5 : 12,
          .chord_reduction = 0.5,
          .stop = stop};
}

/// While it lives, the system gives up its work once it is to stop.
class Obedience {
 public:
  Obedience(DuctSystem& system, const std::atomic<bool>* stop) : system_(system) { system_.obey(stop); }
  ~Obedience() { system_.obey(nullptr); }
  Obedience(const Obedience&) = delete;
  Obedience& operator=(const Obedience&) = delete;

 private:
  DuctSystem& system_;
};

int degree_of(const DuctState& state) { return state.discrete->space.reference().degree(); }

}  // namespace

void DuctLadder::add(DuctState state, const StateNumbers& of_state) {
  if (!keeps_systems && !rungs.empty()) rungs.back().discrete.reset();
  rungs.push_back(std::move(state));
  numbers.push_back(of_state);
  deformations.push_back(of_state.shape.deformation);
  estimated_error = estimate_error(deformations, share_of_change_before);
  if (rungs.size() == 2) estimated_error = std::max(estimated_error, min_error_of_two_rungs);
}

StateNumbers DuctLadder::errors() const { return errors_of_last(numbers, estimated_error, min_share_of_two_rungs); }

double DuctLadder::motion_error(CellPlace place) const {
  const auto error_of = [this](double StateNumbers::*member, double size) {
    std::vector<double> values;
    for (const StateNumbers& rung : numbers) values.push_back(rung.*member);
    const double own = std::abs(values.back());
    return estimate_error(values, share_of_change_before) * own / std::max(own, size);
  };
  if (numbers.size() < 2) return std::numeric_limits<double>::infinity();
  double error = std::max(error_of(&StateNumbers::cell_velocity, 0), error_of(&StateNumbers::spin, 0));
  if (place == CellPlace::given)
    error = std::max(error, error_of(&StateNumbers::drift_velocity, share_of_velocity * numbers.back().cell_velocity));
  return numbers.size() == 2 ? std::max(error, min_error_of_two_rungs) : error;
}

Problem DuctSolver::problem_at(double compliance) const { return with_media(problem_, media_(compliance)); }

DuctState DuctSolver::follow() {
  DuctState state = scout();
  if (state.status == Status::converged || state.status == Status::stopped) return state;
  state = {};
  for (const int degree : ways) {
    DuctState next = state.discrete ? at_degree(state, degree, {.tolerance = tolerance_on_the_way, .stop = stop_})
                                    : enter(degree, options(false));
    if (next.status == Status::converged && next.branch.parameter < 1) advance(next, 1, options(degree == ways.back()));
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

/// The state at the first of the ways by a way that is coarser still; not converged if that is too coarse.
DuctState DuctSolver::scout() {
  DuctState coarse = enter(degree_of_scout, options(false));
  if (coarse.status == Status::converged && coarse.branch.parameter < 1) advance(coarse, 1, options(false));
  if (coarse.status != Status::converged) return coarse;
  DuctState state = at_degree(coarse, ways.front(), {.tolerance = tolerance_on_the_way, .stop = stop_});
  if (state.status == Status::stopped) {
    coarse.status = state.status;
    return coarse;
  }
  if (state.status == Status::converged && !is_stable(state)) state.status = Status::surface_unstable;
  return state;
}

Status DuctSolver::climb(DuctState& state, DuctLadder& ladder) {
  if (ladder.rungs.empty()) add(state, ladder);
  while (error_of(ladder) > problem_.accuracy) {
    const int degree = degree_of(ladder.rungs.back()) + 1;
    if (degree > last_degree_of(problem_)) return Status::accuracy_not_reached;
    // Two degrees' factors at a time would take the most memory.
    if (!ladder.keeps_systems) ladder.rungs.back().discrete->system.drop_factors();
    DuctState next = at_degree(ladder.rungs.back(), degree, fine_newton(problem_, stop_));
    if (next.status != Status::converged) return next.status;
    if (wants_stable_ && !is_stable(next)) return Status::surface_unstable;
    state = next;
    add(std::move(next), ladder);
  }
  return Status::converged;
}

double DuctSolver::stability_margin(double compliance, const DuctSpace& space, const VectorXd& unknowns) const {
  return duct_stability_margin(problem_at(compliance), space, unknowns);
}

bool DuctSolver::is_stable(const DuctState& state) const {
  return stability_margin(state.branch.parameter, state.discrete->space, state.branch.unknowns) >= 0;
}

void DuctSolver::add(DuctState state, DuctLadder& ladder) {
  const StateNumbers numbers = duct_numbers(problem_at(state.branch.parameter), *state.discrete, state.branch.unknowns);
  report(state.branch, numbers.shape.deformation, degree_of(state));
  ladder.add(std::move(state), numbers);
  result_->estimated_error = error_of(ladder);
  result_->deformation_floor = deformation_floor(problem_);
  result_->errors = ladder.errors();
}

double DuctSolver::error_of(const DuctLadder& ladder) const {
  const bool by_motion = problem_.accuracy_of == AccuracyOf::motion && problem_.offset != 0;
  return by_motion ? ladder.motion_error(problem_.place)
                   : stated_error(problem_, ladder.estimated_error, ladder.deformations.back());
}

Status DuctSolver::carry(const Problem& from, const DuctLadder& ladder, DuctLadder& carried) {
  VectorXd before;  // of the last rung, on the mesh of this problem
  for (const DuctState& rung : ladder.rungs) {
    DuctState next = moved(from, rung);
    const VectorXd kept = next.branch.unknowns;
    if (!carried.rungs.empty()) {
      // What changed at the lower degree changes here, too.
      const DuctState& coarse = carried.rungs.back();
      const DuctSpace &lower = coarse.discrete->space, &space = next.discrete->space;
      next.branch.unknowns += transfer(lower, coarse.branch.unknowns, space) - transfer(lower, before, space);
    }
    NewtonOptions options = fine_newton(problem_, stop_);
    options.keep_factors = next.discrete->system.has_factors();
    const DuctState found = solved(next.discrete, next.branch, options);
    const bool is_good = found.status == Status::converged &&
                         found.discrete->system.stretch_change(kept, found.branch.unknowns) < max_stretch_change &&
                         is_stable(found);
    if (!is_good) {
      carried.rungs.push_back(found);  // it holds the factors
      return found.status == Status::stopped ? Status::stopped : Status::branch_ended;
    }
    before = kept;
    add(found, carried);
    if (error_of(carried) <= problem_.accuracy) break;
  }
  return Status::converged;
}

/// The rung on the mesh of this problem. Factors are exchanged, not copied.
DuctState DuctSolver::moved(const Problem& from, const DuctState& rung) {
  DuctState to = rung;
  if (has_same_mesh(from, problem_)) return to;
  to.discrete = std::make_shared<DuctDiscrete>(problem_, subdivision_of(problem_), degree_of(rung));
  to.discrete->system.exchange_factors(rung.discrete->system);
  to.discrete->system.scale_displacement(problem_.radius_ratio / from.radius_ratio, to.branch.unknowns);
  return to;
}

ContinuationOptions DuctSolver::options(bool last, double least_margin) {
  ContinuationOptions options;
  options.newton = {.tolerance = tolerance_on_the_way, .iteration_limit = 6, .stop = stop_};
  options.min_step = last ? min_step_at_last : min_step_before_refining;
  options.accept = [this, least_margin](const NonlinearSystem& system, const BranchState& state) {
    const DuctSpace& space = static_cast<const DuctSystem&>(system).space();
    if (stability_margin(state.parameter, space, state.unknowns) < least_margin) return false;
    report(state, duct_deformation(space, state.unknowns, camera_in_mesh(problem_)), space.reference().degree());
    return true;
  };
  return options;
}

std::shared_ptr<DuctDiscrete> DuctSolver::discrete(int degree) {
  if (const auto found = discrete_.find(degree); found != discrete_.end()) return found->second;
  auto made = std::make_shared<DuctDiscrete>(problem_, subdivision_of(problem_), degree);
  if (keeps_systems_) discrete_[degree] = made;
  return made;
}

DuctState DuctSolver::enter(int degree, const ContinuationOptions& options) {
  DuctState state;
  state.discrete = discrete(degree);
  const Obedience obedience(state.discrete->system, stop_);
  const WorkMeter before = state.discrete->system.work();
  take(state, start_branch(stiffness_path(state.discrete->system, media_), options));
  result_->statistics += state.discrete->system.work() - before;
  return state;
}

void DuctSolver::advance(DuctState& state, double compliance, const ContinuationOptions& options) {
  const Obedience obedience(state.discrete->system, stop_);
  const WorkMeter before = state.discrete->system.work();
  Path path = stiffness_path(state.discrete->system, media_);
  path.end = compliance;
  take(state, continue_branch(path, options, state.branch));
  result_->statistics += state.discrete->system.work() - before;
}

DuctState DuctSolver::at_degree(const DuctState& from, int degree, const NewtonOptions& options) {
  const auto to = discrete(degree);
  return solved(to, {from.branch.parameter, transfer(from.discrete->space, from.branch.unknowns, to->space), {}, 0},
                options);
}

DuctState DuctSolver::at_compliance(const DuctState& near, double compliance, VectorXd guess) {
  return solved(near.discrete, {compliance, std::move(guess), {}, 0},
                {.tolerance = tolerance_on_the_way, .stop = stop_});
}

DuctState DuctSolver::solved(std::shared_ptr<DuctDiscrete> at, BranchState guess, const NewtonOptions& options) {
  DuctState to{.discrete = std::move(at), .branch = std::move(guess)};
  DuctSystem& system = to.discrete->system;
  const Obedience obedience(system, stop_);
  const WorkMeter before = system.work();
  const NewtonReport report = newton(system, media_(to.branch.parameter), options, to.branch.unknowns);
  to.status = report.status;
  to.residual = report.residual;
  to.branch.newton_iterations = report.iterations;
  result_->statistics.newton_iterations += report.iterations;
  result_->statistics += system.work() - before;
  return to;
}

void DuctSolver::take(DuctState& state, const ContinuationReport& report) {
  state.status = report.status;
  state.branch = report.last;
  state.residual = report.residual;
  result_->statistics.newton_iterations += report.newton_iterations;
  result_->statistics.continuation_steps += report.steps;
}

void DuctSolver::report(const BranchState& state, double deformation, int degree) {
  result_->branch.push_back({state.parameter, deformation, state.newton_iterations, degree});
  if (progress_) progress_(result_->branch.back());
}

}  // namespace rheocyte
