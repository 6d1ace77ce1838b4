// The splitting of Mokbel et al. 2017 (docs/theory-time.md, sec. 3): the reference that the implicit steps are compared
// with.
#pragma once
#include "fem/split_system.h"
#include "solve/stepper.h"

namespace rheocyte {

struct PartitionedOptions {
  double step = 2e-3;        ///< in R/U
  double relaxation = 0.25;  ///< fraction of the new traction in each step
};

class PartitionedStepper final : public Stepper {
 public:
  PartitionedStepper(const Problem&, const Resolution&, const PartitionedOptions&);

  Status start() override;
  TimeStepReport step(double limit) override;
  /// Linear between the last two levels.
  TimeLevel level_at(double time) const override;
  double next_position(double time) const override;
  WorkMeter work() const override;
  const Discrete& discrete() const override { return discrete_; }
  const NonlinearSystem& system() const override { return discrete_.system(); }

 private:
  /// eq:controller
  double controlled_pressure(const VectorXd& unknowns) const;

  PartitionedOptions options_;
  TubeDiscrete discrete_;
  SplitSystem system_;
};

}  // namespace rheocyte
