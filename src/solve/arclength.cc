#include "solve/arclength.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rheocyte {
namespace {

/// Tangent of a branch with respect to its arc.
struct ArcTangent {
  VectorXd unknowns;
  double parameter = 0;
};

class ArcTracer {
 public:
  ArcTracer(const Path& path, const ArcOptions& options, const BranchState& start)
      : path_(path),
        options_(options),
        system_(path.system(start.parameter)),
        unit_(path.unit(start.parameter)),
        scale_(residual_scale(system_, path.media(start.parameter))) {}

  /// Where the system is factorised.
  VectorXd rate(const BranchState& state) { return system_.solve(-parameter_slope(path_, state)); }

  /// Of the first rate follows what arcs are measured in.
  void measure_by(const VectorXd& rate) {
    const double displacement = system_.largest_displacement(rate) / system_.cell_radius();
    weight_ = displacement > 0 ? std::pow(displacement, 2) / rate.squaredNorm() : 1;
  }

  /// d/d(arc), pointing as `like` does.
  ArcTangent tangent(const VectorXd& rate, const ArcTangent& like) const {
    const double length = std::sqrt(weight_ * rate.squaredNorm() + 1 / (unit_ * unit_));
    const double forward = weight_ * rate.dot(like.unknowns) + like.parameter / (unit_ * unit_);
    const double scale = (forward < 0 ? -1 : 1) / length;
    return {scale * rate, scale};
  }

  /// Newton on the equations and the plane at distance `step` along the tangent.
  Status correct(const BranchState& from, const ArcTangent& t, double step, BranchState& state) {
    for (int i = 0; i < options_.newton.iteration_limit; ++i) {
      if (is_stopped()) return Status::stopped;
      const auto [residual, min_det] = system_.linearise(path_.media(state.parameter), state.unknowns);
      state.newton_iterations = i;
      if (is_stopped()) return Status::stopped;
      if (!system_.has_factors()) return residual.allFinite() ? Status::singular_matrix : Status::not_finite;
      if (min_det <= 0) return Status::mesh_folded;
      if (i > 0 && residual.norm() < options_.newton.tolerance * scale_) return Status::converged;
      const VectorXd straight = system_.solve(-residual), along = rate(state);
      const double off = weight_ * t.unknowns.dot(state.unknowns - from.unknowns) +
                         t.parameter * (state.parameter - from.parameter) / (unit_ * unit_) - step;
      const double change = -(off + weight_ * t.unknowns.dot(straight)) /
                            (weight_ * t.unknowns.dot(along) + t.parameter / (unit_ * unit_));
      if (!std::isfinite(change)) return Status::not_finite;
      state.unknowns += straight + change * along;
      state.parameter += change;
      if (!(state.parameter > 0)) return Status::not_finite;
    }
    return Status::iteration_limit;
  }

  bool is_near(const VectorXd& guess, const VectorXd& found) const {
    return system_.stretch_change(guess, found) < options_.max_correction;
  }

 private:
  bool is_stopped() const { return options_.newton.stop && *options_.newton.stop; }

  const Path& path_;
  const ArcOptions& options_;
  NonlinearSystem& system_;
  double unit_, scale_, weight_ = 1;
};

}  // namespace

ArcReport trace_arc(const Path& path, const ArcOptions& options, BranchState from) {
  ArcReport report;
  ArcTracer tracer(path, options, from);
  NonlinearSystem& system = path.system(from.parameter);
  system.linearise(path.media(from.parameter), from.unknowns);
  if (!system.has_factors()) return report.status = Status::singular_matrix, report;
  const VectorXd first_rate = tracer.rate(from);
  tracer.measure_by(first_rate);
  ArcTangent t = tracer.tangent(first_rate, {VectorXd::Zero(from.unknowns.size()), 1});
  const auto add = [&](BranchState state, double step) {
    state.tangent = t.unknowns;
    report.arcs.push_back(report.arcs.empty() ? 0 : report.arcs.back() + step);
    report.slopes.push_back(t.parameter);
    report.states.push_back(std::move(state));
  };
  add(std::move(from), 0);
  double step = options.first_step;
  while (int(report.states.size()) <= options.step_limit) {
    const BranchState& last = report.states.back();
    BranchState next;
    next.unknowns = last.unknowns + step * t.unknowns;
    next.parameter = last.parameter + step * t.parameter;
    const VectorXd guess = next.unknowns;
    report.status = tracer.correct(last, t, step, next);
    report.newton_iterations += next.newton_iterations + 1;
    if (report.status == Status::stopped) return report;
    if (report.status == Status::converged && !tracer.is_near(guess, next.unknowns))
      report.status = Status::branch_ended;
    if (report.status != Status::converged) {
      step /= 2;
      if (step < options.min_step) return report;
      continue;
    }
    const double slope_before = t.parameter;
    t = tracer.tangent(tracer.rate(next), t);
    if (t.parameter * slope_before < 0) report.folds.push_back(int(report.states.size()) - 1);
    const bool is_easy = next.newton_iterations <= 3;
    add(std::move(next), step);
    if (is_easy) step = std::min(1.5 * step, options.max_step);
    if (int(report.folds.size()) >= options.fold_limit || (options.go_on && !options.go_on(report.states.back())))
      break;
  }
  report.status = Status::converged;
  return report;
}

double turning_parameter(const ArcReport& report, int fold) {
  const double rising = report.slopes[fold], falling = report.slopes[fold + 1];
  const double to_turn = rising / (rising - falling) * (report.arcs[fold + 1] - report.arcs[fold]);
  return report.states[fold].parameter + 0.5 * rising * to_turn;
}

}  // namespace rheocyte
