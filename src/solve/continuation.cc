#include "solve/continuation.h"

#include <algorithm>
#include <cmath>

namespace rheocyte {
namespace {

/// Parabola through the last state with its tangent and the tangent before, at distance h.
VectorXd predict(const BranchState& now, const BranchState* before, double h) {
  VectorXd guess = now.unknowns + h * now.tangent;
  if (before) {
    guess += 0.5 * h * h / (now.parameter - before->parameter) * (now.tangent - before->tangent);
  }
  return guess;
}

bool is_stopped(const ContinuationOptions& options) { return options.newton.stop && *options.newton.stop; }

/// Changes of the liquid's thinning in one step, and the least one.
constexpr double thinning_step = 0.2, min_thinning_step = 0.01;
/// Of the residual in the liquids between, whose states are but guesses for the next.
constexpr double tolerance_between = 1e-3;

/// Newton at one compliance from a guess in the Newtonian liquid. A power law is singular where nothing flows yet, so
/// the liquid is approached from the Newtonian one in steps that halve where Newton fails.
NewtonReport enter_branch(const Path& path, const ContinuationOptions& options, double compliance, VectorXd& unknowns) {
  NewtonReport report;
  Media media = path.media(compliance);
  const Liquid liquid = media.liquid;
  const double way = thinning(liquid);
  double reached = 0, step = way > 0 ? std::min(1.0, thinning_step / way) : 1;
  int iterations = 0;
  for (bool first = true; first || (way > 0 && reached < 1);) {
    const double fraction = first ? 0 : 1 - reached - step < 1e-9 ? 1 : reached + step;
    media.liquid = at_thinning(liquid, fraction);
    VectorXd trial = unknowns;
    NewtonOptions newton_options = options.newton;
    if (way > 0 && fraction < 1) newton_options.tolerance = std::max(tolerance_between, newton_options.tolerance);
    report = newton(path.system(compliance), media, newton_options, trial);
    report.iterations = iterations += report.iterations;
    if (report.status == Status::converged) {
      unknowns = trial;
      reached = fraction;
      first = false;
    } else {
      step /= 2;
      if (first || report.status == Status::stopped || step * way < min_thinning_step) break;
    }
  }
  return report;
}

}  // namespace

/// Central difference: everything is smooth in the parameter, and a predictor needs no more than the 1e-9 that this
/// gives.
VectorXd parameter_slope(const Path& path, const BranchState& state) {
  const double h = 1e-5 * path.unit(state.parameter);
  const auto residual = [&](double parameter) {
    return path.system(parameter).residual(path.media(parameter), state.unknowns).value;
  };
  return (residual(state.parameter + h) - residual(state.parameter - h)) / (2 * h);
}

/// After chord steps the factorisation is the one of a state nearby, and the tangent is good to some per cent: a fresh
/// one would cost more than it saves.
VectorXd branch_tangent(const Path& path, const BranchState& state) {
  return path.system(state.parameter).solve(-parameter_slope(path, state));
}

ContinuationReport start_branch(const Path& path, const ContinuationOptions& options) {
  ContinuationReport report;
  NonlinearSystem& system = path.system(path.end);
  Media wanted = path.media(path.end);
  wanted.liquid = at_thinning(wanted.liquid, 0);
  const VectorXd sphere = system.sphere();
  const VectorXd residual = system.linearise(wanted, sphere).value;
  report.newton_iterations = 1;
  if (is_stopped(options)) return report.status = Status::stopped, report;
  if (!system.has_factors()) {
    report.status = residual.allFinite() ? Status::singular_matrix : Status::not_finite;
    return report;
  }
  const VectorXd response = system.solve(-residual);
  const double displacement = system.largest_displacement(response) / system.cell_radius();

  // The displacement is proportional to the compliance at first; velocity and pressure do not depend on it.
  BranchState& state = report.last;
  state.parameter = std::min(1.0, options.displacement_per_step / displacement);
  state.unknowns = sphere + response;
  system.scale_displacement(state.parameter, state.unknowns);
  for (; state.parameter > 1e-6; state.parameter /= 4, system.scale_displacement(0.25, state.unknowns)) {
    VectorXd unknowns = state.unknowns;
    const NewtonReport newton_report = enter_branch(path, options, state.parameter, unknowns);
    report.newton_iterations += newton_report.iterations;
    report.status = newton_report.status;
    report.residual = newton_report.residual;
    if (report.status == Status::stopped) return report;
    if (report.status != Status::converged) continue;
    BranchState found{state.parameter, unknowns, {}, report.newton_iterations};
    if (options.accept && !options.accept(system, found)) {
      report.status = Status::surface_unstable;
      continue;
    }
    found.tangent = branch_tangent(path, found);
    state = std::move(found);
    report.steps = 1;
    return report;
  }
  state.parameter = 0;
  return report;
}

namespace {

/// The next step: not beyond the end, and no small rest left for the step after.
double limited_step(const Path& path, double parameter, double h) {
  if (std::isfinite(path.origin)) h = std::min(h, 1.5 * path.unit(parameter));  // curved beyond the first states
  const double remaining = path.end - parameter;
  if (h >= remaining) return remaining;
  return h > 0.7 * remaining ? 0.5 * remaining : h;
}

/// Whether Newton found a state, near its prediction.
Status judge(const NewtonReport& newton, const NonlinearSystem& system, const VectorXd& guess, const VectorXd& found,
             const ContinuationOptions& options) {
  if (newton.status != Status::converged) return newton.status;
  return system.stretch_change(guess, found) < options.max_correction ? Status::converged : Status::branch_ended;
}

}  // namespace

ContinuationReport continue_branch(const Path& path, const ContinuationOptions& options, BranchState from) {
  ContinuationReport report;
  report.status = Status::converged;
  report.last = std::move(from);
  BranchState& last = report.last;
  if (last.tangent.size() == 0) {
    path.system(last.parameter).linearise(path.media(last.parameter), last.unknowns);
    if (is_stopped(options)) return report.status = Status::stopped, report;
    last.tangent = branch_tangent(path, last);
  }
  BranchState before;
  const auto displacement_rate = [&](const BranchState& state) {
    const NonlinearSystem& system = path.system(state.parameter);
    return std::max(system.largest_displacement(state.tangent) / system.cell_radius(), 1e-12);
  };
  double h = options.displacement_per_step / displacement_rate(last), aim = last.aim;
  if (last.step > 0) h = std::min(h, last.step);
  while (last.parameter < path.end) {
    h = limited_step(path, last.parameter, h);
    BranchState next;
    next.parameter = h >= path.end - last.parameter ? path.end : last.parameter + h;
    NonlinearSystem& system = path.system(next.parameter);
    const VectorXd guess = predict(last, before.tangent.size() > 0 ? &before : nullptr, h);
    next.unknowns = guess;
    const NewtonReport newton_report = newton(system, path.media(next.parameter), options.newton, next.unknowns);
    report.newton_iterations += newton_report.iterations;
    next.newton_iterations = newton_report.iterations;
    Status status = judge(newton_report, system, guess, next.unknowns, options);
    if (status == Status::stopped) return report.status = status, report;
    if (status == Status::converged && options.accept && !options.accept(system, next))
      status = Status::surface_unstable;
    if (status != Status::converged) {
      if (newton_report.first_correction > 0)
        aim = std::clamp(0.5 * newton_report.first_correction / system.cell_radius(), min_aim, aim);
      h /= 2;
      if (h < options.min_step * path.unit(last.parameter)) return report.status = status, report;
      continue;
    }
    report.residual = newton_report.residual;
    next.tangent = branch_tangent(path, next);
    before = std::move(last);
    last = std::move(next);
    ++report.steps;
    // With an exact tangent the predictor's error grows like h^3.
    const double radius = system.cell_radius();
    const double growth = std::cbrt(aim * radius / std::max(newton_report.first_correction, 1e-12));
    aim = std::min(1.2 * aim, max_aim);
    h = std::min(h * std::clamp(growth, 0.4, 2.5), 2 * options.displacement_per_step / displacement_rate(last));
    last.step = h;
    last.aim = aim;
    if (options.pause && options.pause(last)) return report;
  }
  return report;
}

}  // namespace rheocyte
