// The splitting of Mokbel et al. 2017 (docs/theory-time.md, sec. 4): the reference that the implicit steps are compared
// with.
#pragma once
#include <memory>

#include "fem/split_system.h"
#include "solve/outcome.h"
#include "solve/path.h"

namespace rheocyte {

struct PartitionedOptions {
  double step = 2e-3;        ///< in R/U
  double relaxation = 0.25;  ///< share of the new traction in each step
};

class PartitionedStepper {
 public:
  PartitionedStepper(const Problem&, const Resolution&, const PartitionedOptions&);

  /// The unstressed sphere at time zero, in the steady flow round it as if it were rigid.
  Status start();
  Status step();

  double time() const { return time_; }
  const SplitState& state() const { return state_; }
  const Discretisation& space() const { return discrete_->space; }

 private:
  PartitionedOptions options_;
  std::shared_ptr<Discrete> discrete_;
  SplitSystem system_;
  Media media_;
  double time_ = 0;
  SplitState state_;
};

}  // namespace rheocyte
