// What is recorded of a cell on its way.
#pragma once
#include <tuple>
#include <vector>

#include "state/state_measures.h"

namespace rheocyte {

/// A step or an output; dimensionless.
struct TimePoint {
  double time = 0, step = 0;
  int order = 0, newton_iterations = 0, refused_steps = 0;
  double position = 0;  ///< of the cell along the channel, from its start
  StateNumbers state;
};

/// All steps and outputs of a run; or, point by point, the errors of their times, positions and numbers, absolute.
struct TimeWay {
  std::vector<TimePoint> steps, outputs;

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& way) {
    return std::tie(way.steps, way.outputs);
  }
};

}  // namespace rheocyte
