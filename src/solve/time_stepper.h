// The cell on its way, step by step (docs/theory-time.md, sec. 2): implicit steps of controlled size and order.
#pragma once
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "laws/wall_profile.h"
#include "solve/bdf.h"
#include "solve/moving_discrete.h"
#include "solve/newton.h"
#include "solve/stepper.h"

namespace rheocyte {

struct TimeStepOptions {
  double accuracy = 1e-5;    ///< of the surface's positions in each step, in r0
  double first_step = 1e-3;  ///< in R/U
  double min_step = 1e-13;
  double max_step = 1;  ///< before and between walls that are not straight
  int max_order = max_bdf_order;
  double fixed_step = 0;  ///< > 0: all steps have this size and, as soon as there are enough levels, the greatest order
  NewtonOptions newton = {1e-9};
  int threads = 1;  ///< at most
};

class TimeStepper final : public Stepper {
 public:
  TimeStepper(const Problem&, const Resolution&, const TimeStepOptions&);
  /// By a discretisation that is not that of the problem's section.
  TimeStepper(const Problem&, std::unique_ptr<MovingDiscrete>, const TimeStepOptions&);

  Status start() override;
  TimeStepReport step(double limit) override;
  /// By the polynomial of the formula.
  TimeLevel level_at(double time) const override;
  double next_position(double time) const override;
  void move_walls(double time) override;
  WorkMeter work() const override { return system().work(); }
  const Discrete& discrete() const override { return moving_->discrete(); }
  const NonlinearSystem& system() const override { return std::as_const(*moving_).system(); }

 private:
  struct Trial;
  Trial attempt(double step, int order);
  /// With the factors that steps keep from one to the next, in a run that goes on from a state, too.
  NewtonReport solve(const Motion&, TimeLevel&);
  void renew_factors();
  /// Of the surface's positions, and of the cell's along its offset by a difference of its drift over the rate.
  double surface_change(const VectorXd& difference, double rate) const;
  StepErrors errors(const Trial&, int order) const;
  void accept(const Trial&, int order);
  VectorXd extrapolate(int levels, double time, VectorXd TimeLevel::*field = &TimeLevel::unknowns) const;
  VectorXd combine(const VectorXd& weights, VectorXd TimeLevel::*field) const;
  double combine(const VectorXd& weights, double TimeLevel::*field) const;
  /// Of the levels that the formula's polynomial goes through, at a time within the last or the next step.
  VectorXd weights_at(double time) const;
  /// Of the frame after a step with the formula, its velocity extrapolated.
  double place_after(const BdfFormula&, double velocity, double TimeLevel::*place) const;
  /// Where the walls move the nodes with the cell at a level's place; moves them.
  VectorXd meet_walls(const TimeLevel& level, const VectorXd& unknowns);
  bool moves_mesh() const { return wall_.has_value() || moving_->drift() >= 0; }

  TimeStepOptions options_;
  std::optional<WallProfile> wall_;  ///< of a channel that is not straight
  std::unique_ptr<MovingDiscrete> moving_;
  std::vector<int> surface_;  ///< displacements of the surface
};

}  // namespace rheocyte
