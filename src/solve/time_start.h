// Where a computation in time starts if not from the sphere.
#pragma once
#include <optional>

#include "fem/discretisation.h"
#include "solve/time_state.h"
#include "solve/time_way.h"

namespace rheocyte {

/// Units of one problem in those of another one.
struct UnitChange {
  double velocity = 1, stress = 1;
};

/// A state of an earlier run: to go on with, or, with units, as the start at time zero of another problem on the same
/// mesh.
struct TimeStart {
  TimeState state;
  std::optional<UnitChange> units = {};
  TimeWay before = {};  ///< what was recorded on the way there
};

/// The shape, the flow and the pressures of the last level at time zero, in new units. For the spaces of tube and duct,
/// whose vectors have 2 and 3 directions.
template <class Space>
TimeState at_time_zero(const Space&, int directions, const TimeState&, const UnitChange&);

}  // namespace rheocyte
