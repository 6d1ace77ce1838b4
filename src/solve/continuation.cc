#include "solve/continuation.h"

#include <algorithm>
#include <cmath>

#include "fem/observe.h"

namespace rheocyte {
namespace {

/// d(residual)/d(compliance) by a central difference: the stress is smooth in the modulus, and a predictor needs no
/// more than the 1e-9 that this gives.
VectorXd parameter_slope(StationarySystem& system, const Problem& problem, const BranchState& state) {
  const double h = 1e-5 * state.compliance;
  double det = 0;
  const VectorXd plus = system.residual(media_at(problem, state.compliance + h), state.unknowns, det);
  const VectorXd minus = system.residual(media_at(problem, state.compliance - h), state.unknowns, det);
  return (plus - minus) / (2 * h);
}

/// The tangent, with the factorisation that Newton left. After chord steps that is the one of a state nearby, and the
/// tangent is good to some per cent: a fresh factorisation would cost more than it saves.
VectorXd branch_tangent(StationarySystem& system, const Problem& problem, const BranchState& state) {
  return system.solve(-parameter_slope(system, problem, state));
}

/// Greatest relative difference of the surface's meridional stretch between two states.
double stretch_change(const Discretisation& space, const VectorXd& from, const VectorXd& to) {
  const int per_edge = 2 * space.reference().degree();
  const Eigen::ArrayXd a = surface_state(space, from, per_edge).stretch.col(0);
  const Eigen::ArrayXd b = surface_state(space, to, per_edge).stretch.col(0);
  return ((b - a) / b).abs().maxCoeff();
}

/// Parabola through the last state with its tangent and the tangent before, at distance h.
VectorXd predict(const BranchState& now, const BranchState* before, double h) {
  VectorXd guess = now.unknowns + h * now.tangent;
  if (before) {
    guess += 0.5 * h * h / (now.compliance - before->compliance) * (now.tangent - before->tangent);
  }
  return guess;
}

/// The problem in a liquid of another exponent; 1 is the Newtonian one.
Problem with_exponent(Problem problem, double exponent) {
  problem.exponent = exponent;
  if (exponent == 1) problem.liquid = LiquidLaw::newtonian;
  return problem;
}

/// Newton at one compliance from a guess in the Newtonian liquid. A power law is singular where nothing flows yet, so
/// its exponent is approached from 1 in steps that halve where Newton fails.
NewtonReport enter_branch(StationarySystem& system, const Problem& problem, const ContinuationOptions& options,
                          double compliance, VectorXd& unknowns) {
  NewtonReport report;
  int iterations = 0;
  const double wanted = problem.exponent;
  double reached = 1, step = std::clamp(wanted - 1, -0.2, 0.2);
  for (bool first = true; first || reached != wanted;) {
    double exponent = first ? 1 : reached + step;
    if (std::abs(exponent - wanted) < 1e-9 || (exponent - wanted) * (1 - wanted) < 0) exponent = wanted;
    VectorXd trial = unknowns;
    report = newton(system, media_at(with_exponent(problem, exponent), compliance), options.newton, trial);
    report.iterations = iterations += report.iterations;
    if (report.status == Status::converged) {
      unknowns = trial;
      reached = exponent;
      first = false;
    } else {
      step /= 2;
      if (first || report.status == Status::stopped || std::abs(step) < 0.01) break;
    }
  }
  return report;
}

}  // namespace

Media media_at(const Problem& problem, double compliance) {
  Media media;
  media.liquid = {problem.liquid, problem.exponent, problem.shear_rate_floor, problem.reynolds};
  media.bulk = {problem.shear_modulus / compliance, problem.mooney_share};
  media.cortex = {problem.cortex, problem.cortex_modulus / compliance, problem.tension / compliance,
                  problem.bending_stiffness / compliance};
  return media;
}

ContinuationReport start_branch(StationarySystem& system, const Problem& problem, const ContinuationOptions& options) {
  ContinuationReport report;
  const Media wanted = media_at(with_exponent(problem, 1), 1);
  double det = 0;
  bool factorised = false;
  const VectorXd sphere = system.sphere();
  const VectorXd residual = system.linearise(wanted, sphere, det, factorised);
  report.newton_iterations = 1;
  if (!factorised) {
    report.status = residual.allFinite() ? Status::singular_matrix : Status::not_finite;
    return report;
  }
  const VectorXd response = system.solve(-residual);
  const double displacement = largest_displacement(system.space(), response) / problem.radius_ratio;

  // The displacement is proportional to the compliance at first; velocity and pressure do not depend on it.
  BranchState& state = report.last;
  state.compliance = std::min(1.0, options.displacement_per_step / displacement);
  state.unknowns = sphere + response;
  scale_displacement(system.space(), state.compliance, state.unknowns);
  for (; state.compliance > 1e-6; state.compliance /= 4, scale_displacement(system.space(), 0.25, state.unknowns)) {
    VectorXd unknowns = state.unknowns;
    const NewtonReport newton_report = enter_branch(system, problem, options, state.compliance, unknowns);
    report.newton_iterations += newton_report.iterations;
    report.status = newton_report.status;
    report.residual = newton_report.residual;
    if (report.status == Status::stopped) return report;
    if (report.status != Status::converged) continue;
    state.unknowns = unknowns;
    state.newton_iterations = report.newton_iterations;
    state.tangent = branch_tangent(system, problem, state);
    report.steps = 1;
    if (options.accept && !options.accept(system.space(), state)) report.status = Status::surface_unstable;
    return report;
  }
  return report;
}

ContinuationReport continue_branch(StationarySystem& system, const Problem& problem, const ContinuationOptions& options,
                                   BranchState from) {
  ContinuationReport report;
  report.status = Status::converged;
  report.last = std::move(from);
  if (report.last.tangent.size() == 0) {
    bool factorised = false;
    double det = 0;
    system.linearise(media_at(problem, report.last.compliance), report.last.unknowns, det, factorised);
    report.last.tangent = branch_tangent(system, problem, report.last);
  }
  BranchState before;
  const double radius = problem.radius_ratio;
  const auto displacement_rate = [&](const BranchState& s) {
    return largest_displacement(system.space(), s.tangent) / radius;
  };
  double h = options.displacement_per_step / displacement_rate(report.last);
  while (report.last.compliance < 1) {
    BranchState next;
    h = std::min(h, 1.5 * report.last.compliance);  // beyond the first states the branch is curved
    const double remaining = 1 - report.last.compliance;
    if (h > 0.7 * remaining) h = h < remaining ? 0.5 * remaining : remaining;
    next.compliance = h >= remaining ? 1 : report.last.compliance + h;
    const bool has_before = before.tangent.size() > 0;
    const VectorXd guess = predict(report.last, has_before ? &before : nullptr, h);
    next.unknowns = guess;
    const NewtonReport newton_report =
        newton(system, media_at(problem, next.compliance), options.newton, next.unknowns);
    report.newton_iterations += newton_report.iterations;
    if (newton_report.status == Status::stopped) return report.status = Status::stopped, report;
    next.newton_iterations = newton_report.iterations;
    const bool near_guess = newton_report.status == Status::converged &&
                            stretch_change(system.space(), guess, next.unknowns) < options.greatest_correction;
    const bool accepted = near_guess && (!options.accept || options.accept(system.space(), next));
    if (!accepted) {
      h /= 2;
      if (h < options.least_step * report.last.compliance) {
        report.status = near_guess                                  ? Status::surface_unstable
                        : newton_report.status == Status::converged ? Status::branch_ended
                                                                    : newton_report.status;
        return report;
      }
      continue;
    }
    report.residual = newton_report.residual;
    next.tangent = branch_tangent(system, problem, next);
    before = std::move(report.last);
    report.last = std::move(next);
    ++report.steps;
    // With an exact tangent the predictor's error grows like h^3: aim at a first correction of 1 % of the radius.
    const double growth = std::cbrt(0.01 * radius / std::max(newton_report.first_correction, 1e-12));
    h = std::min(h * std::clamp(growth, 0.4, 2.5), 2 * options.displacement_per_step / displacement_rate(report.last));
  }
  return report;
}

}  // namespace rheocyte
