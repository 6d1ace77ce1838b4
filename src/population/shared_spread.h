// Recordings whose cells scatter alike (docs/theory-populations.md, eq:shared-spread).
#pragma once
#include <span>

#include "numeric/no_value.h"
#include "population/cell_distribution.h"

namespace rheocyte {

/// The parameters of one recording's cells and the covariance of their errors.
struct RecordingLaw {
  ParameterVector parameters;
  ParameterMatrix covariance;
};

/// How unlike the spreads had been: chi squared of their distances from the shared one, and the probability of more.
struct SpreadsApart {
  double chi_squared = no_value, freedom = no_value, p = no_value;
};

/// Gives all recordings the same spreads and the same correlation, those that their estimates make most likely, and the
/// means that go with them. One recording stays as it is.
SpreadsApart share_spread(std::span<RecordingLaw> recordings);

}  // namespace rheocyte
