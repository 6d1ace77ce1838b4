#include "solve/settle.h"

#include <limits>
#include <utility>

namespace rheocyte {
namespace {

/// The first step in which the load fades, and the minimum one.
constexpr double first_fading = 0.5, min_fading = 0.1;

/// At a fraction t of the way a load of 1 - t times the residual of the first unknowns balances it: they are a state at
/// t = 0.
class LoadedSystem final : public NonlinearSystem {
 public:
  LoadedSystem(NonlinearSystem& system, const Media& media, const VectorXd& first)
      : system_(system), load_(system.residual(media, first).value) {}
  LoadedSystem& at(double fraction) { return fraction_ = fraction, *this; }

  VectorXd sphere() const override { return system_.sphere(); }
  Residual residual(const Media& media, const VectorXd& unknowns) override {
    return loaded(system_.residual(media, unknowns));
  }
  Residual linearise(const Media& media, const VectorXd& unknowns) override {
    Residual residual = loaded(system_.linearise(media, unknowns));
    has_factors_ = system_.has_factors();
    return residual;
  }
  VectorXd solve(const VectorXd& rhs) override { return system_.solve(rhs); }
  MatrixXd solve_columns(const MatrixXd& rhs) override { return system_.solve_columns(rhs); }
  double cell_radius() const override { return system_.cell_radius(); }
  double largest_displacement(const VectorXd& unknowns) const override {
    return system_.largest_displacement(unknowns);
  }
  void scale_displacement(double factor, VectorXd& unknowns) const override {
    system_.scale_displacement(factor, unknowns);
  }
  double stretch_change(const VectorXd& from, const VectorXd& to) const override {
    return system_.stretch_change(from, to);
  }
  std::size_t memory_bytes() const override { return system_.memory_bytes(); }
  void drop_factors() override { system_.drop_factors(); }

 private:
  Residual loaded(Residual residual) const {
    if (fraction_ < 1) residual.value -= (1 - fraction_) * load_;
    return residual;
  }

  NonlinearSystem& system_;
  VectorXd load_;
  double fraction_ = 0;
};

}  // namespace

ContinuationReport settle(NonlinearSystem& system, const Media& media, VectorXd guess, const NewtonOptions& newton) {
  LoadedSystem loaded(system, media, guess);
  Path path;
  path.system = [&](double fraction) -> NonlinearSystem& { return loaded.at(fraction); };
  path.media = [&](double) { return media; };
  path.origin = -std::numeric_limits<double>::infinity();
  ContinuationOptions options;
  options.newton = newton;
  options.newton.residual_scale = residual_scale(system, media);
  options.min_step = min_fading;
  BranchState first;
  first.unknowns = std::move(guess);
  first.step = first_fading;
  return continue_branch(path, options, std::move(first));
}

NewtonReport newton_or_settle(NonlinearSystem& system, const Media& media, const NewtonOptions& options,
                              VectorXd& unknowns) {
  const VectorXd guess = unknowns;
  NewtonReport report = newton(system, media, options, unknowns);
  if (report.status == Status::converged || report.status == Status::stopped) return report;
  ContinuationReport settled = settle(system, media, guess, options);
  report.status = settled.status;
  report.residual = settled.residual;
  report.iterations += settled.newton_iterations;
  unknowns = std::move(settled.last.unknowns);
  return report;
}

}  // namespace rheocyte
