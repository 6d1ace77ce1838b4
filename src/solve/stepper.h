// What every scheme in time offers.
#pragma once
#include "fem/coupled_system.h"
#include "solve/time_state.h"
#include "solve/tube.h"
#include "state/outcome.h"

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
  /// Time, unknowns, position and the frame's acceleration at a time within the last step.
  virtual TimeLevel level_at(double time) const = 0;
  /// Where the next step takes the cell if it ends at `time`.
  virtual double next_position(double time) const = 0;
  /// When the cell is at a place within the last step, or at one that it reaches in the next; HUGE_VAL: later.
  double time_at(double position) const;
  /// Moves the mesh to where the walls are at a time within the last step; for looking at the unknowns of that time.
  virtual void move_walls(double) {}
  /// Of all steps so far.
  virtual WorkMeter work() const = 0;

  /// Whether all of the simulated channel lies behind the walls that are not straight.
  bool has_passed_walls(const TimeLevel&) const;

  /// Goes on from a state of the same problem and resolution.
  void resume(TimeState state) { state_ = std::move(state); }
  const TimeState& state() const { return state_; }
  const TimeLevel& now() const { return state_.levels.front(); }

  virtual const Discrete& discrete() const = 0;
  virtual const NonlinearSystem& system() const = 0;
  /// Of a tube.
  const Discretisation& space() const { return static_cast<const TubeDiscrete&>(discrete()).space(); }
  const Problem& problem() const { return problem_; }  ///< with an elastic interior in any case
  const Media& media() const { return media_; }

 protected:
  Stepper(const Problem&, const Resolution&);

  Problem problem_;
  Resolution resolution_;
  Media media_;
  TimeState state_;
};

}  // namespace rheocyte
