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

/// beta of E ~ stress^beta, and ln E of the condition at the mean of ln(stress), each with the wider of the intervals
/// by the scatter of the recordings about the line (Student's t) and by their sampling.
struct Stiffening {
  double exponent = no_value, lower = no_value, upper = no_value;
  double value = no_value, value_lower = no_value, value_upper = no_value;
  double freedom = no_value;  ///< recordings less 2
};

/// How many stresses there are that differ by more than their own scatter: by 5 %.
int distinct_stresses(std::span<const MeanAtStress> means);
/// With fewer stresses nothing distinguishes a power from any other law.
inline constexpr int fewest_stresses_of_a_power = 3;

/// The straight line of least squares. At least fewest_stresses_of_a_power stresses that differ (asserted).
Stiffening stiffening_of(std::span<const MeanAtStress> means, double level);

}  // namespace rheocyte
