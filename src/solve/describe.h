// What is told of a state of cell and liquid, stationary or on its way.
#pragma once
#include <memory>

#include "fem/observe.h"
#include "solve/path.h"
#include "solve/stationary.h"

namespace rheocyte {

/// A state of a discretisation.
struct DiscreteState {
  std::shared_ptr<Discrete> discrete;
  Media media;
  VectorXd unknowns;
};

/// What numbers are read off: the unknowns under a problem's laws.
struct StateView {
  const Problem& problem;
  const Media& media;
  const Discretisation& space;
  const VectorXd& unknowns;
};

/// All numbers of a state, with its contour and its surface as finely as wanted.
StateNumbers numbers_of(const StateView&, const Contour&, const SurfaceState&);
/// With the surface as finely as it is written.
StateNumbers numbers_of(const StateView&);

/// Fills in contour, surface, numbers, sizes and the writer of fields; the outcome, errors and counts of work are left
/// alone.
void describe_state(const Problem&, const DiscreteState&, StationaryState&);

}  // namespace rheocyte
