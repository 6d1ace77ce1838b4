#include "arclength.h"

#include <algorithm>
#include <cmath>

#include "fem/observe.h"

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
      : path_(path), options_(options), system_(path.system(start.parameter)), unit_(path.unit(start.parameter)) {
    const Discretisation& space = space_of(system_);
    for (const BoundaryEdge& edge : space.surface()) {
      for (const int node : edge.nodes) {
        for (int c = 0; c < 2; ++c) {
          if (const int u = space.displacement(node, c); u >= 0) surface_.push_back(u);
        }
      }
    }
    weight_ = 1 / (surface_.size() / 2.0 * std::pow(space.mesh().geometry().radius(), 2));
  }

  /// d/d(arc) at a state where the system is factorised, pointing as `like` does.
  ArcTangent tangent(const BranchState& state, const ArcTangent& like) {
    const VectorXd rate = system_.solve(-parameter_slope(path_, state));
    const double length = std::sqrt(product(rate, rate) + 1 / (unit_ * unit_));
    const double forward = product(rate, like.unknowns) + like.parameter / (unit_ * unit_);
    const double scale = (forward < 0 ? -1 : 1) / length;
    return {scale * rate, scale};
  }

  /// Newton on the equations and the plane at distance `step` along the tangent.
  Status correct(const BranchState& from, const ArcTangent& t, double step, BranchState& state) {
    const double scale = residual_scale(system_, path_.media(from.parameter));
    for (int i = 0; i < options_.newton.iteration_limit; ++i) {
      if (options_.newton.stop && *options_.newton.stop) return Status::stopped;
      const auto [residual, min_det] = system_.linearise(path_.media(state.parameter), state.unknowns);
      state.newton_iterations = i;
      if (!system_.has_factors()) return residual.allFinite() ? Status::singular_matrix : Status::not_finite;
      if (min_det <= 0) return Status::mesh_folded;
      if (i > 0 && residual.norm() < options_.newton.tolerance * scale) return Status::converged;
      const VectorXd straight = system_.solve(-residual), rate = system_.solve(-parameter_slope(path_, state));
      const double off = product(t.unknowns, state.unknowns - from.unknowns) +
                         t.parameter * (state.parameter - from.parameter) / (unit_ * unit_) - step;
      const double change =
          -(off + product(t.unknowns, straight)) / (product(t.unknowns, rate) + t.parameter / (unit_ * unit_));
      if (!std::isfinite(change)) return Status::not_finite;
      state.unknowns += straight + change * rate;
      state.parameter += change;
    }
    return Status::iteration_limit;
  }

  bool is_near(const VectorXd& guess, const VectorXd& found) const {
    return system_.stretch_change(guess, found) < options_.max_correction;
  }
  bool goes_on(const BranchState& state) const { return !options_.go_on || options_.go_on(space_of(system_), state); }

 private:
  double product(const VectorXd& a, const VectorXd& b) const {
    double sum = 0;
    for (const int u : surface_) sum += a(u) * b(u);
    return weight_ * sum;
  }

  const Path& path_;
  const ArcOptions& options_;
  NonlinearSystem& system_;
  double unit_, weight_ = 1;
  std::vector<int> surface_;  ///< unknowns of the surface's displacement; a vertex counts twice
};

}  // namespace

ArcReport trace_arc(const Path& path, const ArcOptions& options, BranchState from) {
  ArcReport report;
  ArcTracer tracer(path, options, from);
  NonlinearSystem& system = path.system(from.parameter);
  system.linearise(path.media(from.parameter), from.unknowns);
  if (!system.has_factors()) return report.status = Status::singular_matrix, report;
  ArcTangent t = tracer.tangent(from, {VectorXd::Zero(from.unknowns.size()), 1});
  from.tangent = t.unknowns;
  report.states.push_back(std::move(from));
  double step = options.first_step;
  while (int(report.states.size()) <= options.step_limit) {
    const BranchState& last = report.states.back();
    BranchState next;
    next.unknowns = last.unknowns + step * t.unknowns;
    next.parameter = last.parameter + step * t.parameter;
    const VectorXd guess = next.unknowns;
    report.status = tracer.correct(last, t, step, next);
    if (report.status == Status::stopped) return report;
    if (report.status == Status::converged && !tracer.is_near(guess, next.unknowns))
      report.status = Status::branch_ended;
    if (report.status != Status::converged) {
      step /= 2;
      if (step < options.min_step) return report;
      continue;
    }
    const ArcTangent after = tracer.tangent(next, t);
    next.tangent = after.unknowns;
    if (after.parameter * t.parameter < 0) report.folds.push_back(int(report.states.size()) - 1);
    t = after;
    const bool goes_on = tracer.goes_on(next);
    if (next.newton_iterations <= 3) step = std::min(1.5 * step, options.max_step);
    report.states.push_back(std::move(next));
    if (!goes_on) break;
  }
  report.status = Status::converged;
  return report;
}

}  // namespace rheocyte
