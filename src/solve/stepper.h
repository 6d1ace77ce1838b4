// What every scheme in time offers.
#pragma once
#include <memory>

#include "fem/coupled_system.h"
#include "solve/outcome.h"
#include "solve/path.h"
#include "solve/time_state.h"

namespace rheocyte {

struct TimeStepReport {
  Status status = Status::not_started;
  double step = 0;
  int order = 0;
  int newton_iterations = 0;  ///< refused steps included
  double residual = 0;        ///< relative, of the last step
  int refused = 0;
};

class Stepper {
 public:
  virtual ~Stepper() = default;

  /// The unstressed sphere at time zero, in the steady flow round it as if it were rigid.
  virtual Status start() = 0;
  /// One accepted step, shortened if it would pass `limit`. If the report is not `converged`, the state is the last
  /// good one.
  virtual TimeStepReport step(double limit) = 0;
  /// Unknowns at a time within the last step.
  virtual VectorXd unknowns_at(double time) const = 0;
  /// Moves the mesh to where the walls are at a time within the last step; for looking at the unknowns of that time.
  virtual void move_walls(double) {}
  /// Of all steps so far.
  virtual WorkMeter work() const = 0;

  /// Goes on from a state of the same problem and resolution.
  void resume(TimeState state) { state_ = std::move(state); }
  const TimeState& state() const { return state_; }
  const TimeLevel& now() const { return state_.levels.front(); }

  const Discretisation& space() const { return discrete_->space; }
  const std::shared_ptr<Discrete>& discrete() const { return discrete_; }
  const Problem& problem() const { return problem_; }  ///< with an elastic interior in any case
  const Media& media() const { return media_; }

 protected:
  Stepper(const Problem&, const Resolution&);

  Problem problem_;
  std::shared_ptr<Discrete> discrete_;
  Media media_;
  TimeState state_;
};

}  // namespace rheocyte
