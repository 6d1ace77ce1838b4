// The stationary shape of one cell in a square duct: from the sphere to the wanted state, and to ever higher degrees
// (docs/theory-square.md).
#pragma once
#include "solve/stationary.h"

namespace rheocyte {

/// As solve_stationary, for a problem in a square section (or, to compare, in a tube) without a cortex and with a given
/// flow rate.
StationaryState solve_in_duct(const Problem&, const ProgressCallback& = {}, const std::atomic<bool>* stop = nullptr);

}  // namespace rheocyte
