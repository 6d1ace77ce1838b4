// How the modulus grows with the stress of the flow: recordings of one condition at several flow rates
// (docs/theory-populations.md, eq:stiffening).
#pragma once
#include <span>

#include "numeric/no_value.h"
#include "population/comparison.h"

namespace rheocyte {

/// Mean of ln E of a recording at this ln of the stress.
struct MeanAtStress {
  RecordingMean mean;
  double log_stress;
};

/// beta of E ~ stress^beta, and the condition at the mean of ln(stress). NaN where there is none.
struct Stiffening {
  double exponent = no_value;
  double freedom = no_value;                  ///< recordings less 2
  double lower = no_value, upper = no_value;  ///< by the scatter of the recordings about the line; Student's t
  double sampling_lower = no_value, sampling_upper = no_value;              ///< as if they did not scatter
  double value = no_value, value_lower = no_value, value_upper = no_value;  ///< of ln E, by the scatter about the line
  bool has_scatter() const { return freedom > 0; }
};

/// Whether the stresses differ by more than their own scatter: by 5 %.
bool differ_in_stress(std::span<const MeanAtStress> means);

/// The straight line of least squares. At least two stresses that differ (asserted).
Stiffening stiffening_of(std::span<const MeanAtStress> means, double level);

}  // namespace rheocyte
