// The place across a duct where a cell does not drift (docs/theory-square.md, sec. 6).
#pragma once
#include "solve/stationary.h"

namespace rheocyte {

/// Solves a problem whose cell stays at its given offset, whatever its place is to be.
using SolveAtOffset = std::function<StationaryState(const Problem&)>;

/// Follows the drift from problem.offset on to the place where it vanishes, first at a tenth of the requested accuracy,
/// and gives the state there with its offset and that offset's error. A cell that drifts to the axis is solved on the
/// axis. Status::no_equilibrium, with the last state, if the drift leads to the wall; if a state on the way is not
/// found, that state and its reason.
StationaryState solve_at_equilibrium(const Problem&, const SolveAtOffset&);

}  // namespace rheocyte
