// The cell on its way, step by step (docs/theory-time.md, sec. 3): implicit steps of controlled size and order.
#pragma once
#include <memory>

#include "fem/moving_system.h"
#include "solve/bdf.h"
#include "solve/newton.h"
#include "solve/path.h"
#include "solve/time_state.h"

namespace rheocyte {

struct TimeStepOptions {
  double accuracy = 1e-5;    ///< of the surface's positions in each step, in r0
  double first_step = 1e-3;  ///< in R/U
  double least_step = 1e-13;
  double greatest_step = 1;
  int greatest_order = greatest_bdf_order;
  double fixed_step = 0;  ///< > 0: all steps have this size and, as soon as there are enough levels, the greatest order
  NewtonOptions newton = {1e-9};
};

struct TimeStepReport {
  Status status = Status::not_started;
  double step = 0;
  int order = 0;
  int newton_iterations = 0;  ///< refused steps included
  double residual = 0;        ///< relative, of the last step
  int refused = 0;
};

class TimeStepper {
 public:
  TimeStepper(const Problem&, const Resolution&, const TimeStepOptions&);

  /// The unstressed sphere at time zero, in the steady flow round it as if it were rigid.
  Status start();
  /// Goes on from a state of the same problem and resolution.
  void resume(TimeState state) { state_ = std::move(state); }

  /// One accepted step, shortened if it would pass `limit`. If the report is not `converged`, the state is the last
  /// good one.
  TimeStepReport step(double limit);

  const TimeState& state() const { return state_; }
  const TimeLevel& now() const { return state_.levels.front(); }
  /// Unknowns at a time within the last step, by the polynomial of the formula.
  VectorXd unknowns_at(double time) const;

  const Discretisation& space() const { return discrete_->space; }
  const std::shared_ptr<Discrete>& discrete() const { return discrete_; }
  const Problem& problem() const { return problem_; }  ///< with an elastic interior in any case
  const Media& media() const { return media_; }
  const WorkMeter& work() const { return system_.work(); }

 private:
  struct Trial;
  Trial attempt(double step, int order);
  double surface_change(const VectorXd& difference) const;
  StepErrors errors(const Trial&, int order) const;
  void accept(const Trial&, int order);
  VectorXd extrapolate(int levels, double time) const;

  Problem problem_;
  TimeStepOptions options_;
  std::shared_ptr<Discrete> discrete_;
  MovingSystem system_;
  Media media_;
  TimeState state_;
};

}  // namespace rheocyte
