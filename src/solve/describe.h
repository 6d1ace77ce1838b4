// What is told of a state of cell and liquid, stationary or on its way.
#pragma once
#include <memory>

#include "solve/path.h"
#include "solve/stationary.h"

namespace rheocyte {

/// A state of a discretisation.
struct DiscreteState {
  std::shared_ptr<Discrete> discrete;
  Media media;
  VectorXd unknowns;
};

/// Fills in shape, surface, flow, sizes and the writer of fields; the outcome, errors and counts of work are left
/// alone.
void describe_state(const Problem&, const DiscreteState&, StationaryState&);

}  // namespace rheocyte
