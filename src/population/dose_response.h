// How a number of the cells follows the dose of a treatment, by the recordings of several doses
// (docs/theory-populations.md, eq:dose-response).
#pragma once
#include <cstddef>
#include <span>

#include "numeric/no_value.h"

namespace rheocyte {

/// Mean of ln of the number in one recording. Recordings of one session have a level in common.
struct MeanAtDose {
  double log_value = 0, dose = 0;
  std::size_t session = 0;
};

/// ln of the number is that without a dose + log_effect * dose / (dose + ec50). Intervals by the scatter of the
/// recordings about this law (Student's t, profiles); NaN where the recordings are too few.
struct DoseResponse {
  double ec50 = no_value, ec50_lower = no_value, ec50_upper = no_value;  ///< an end that is not known: 0, infinity
  double log_effect = no_value;  ///< of a very large dose; NaN where an end of the ec50 is open
  /// Of the straight line through ln of the number over log10 of the dose, without the recordings of dose 0.
  double slope_per_decade = no_value, slope_lower = no_value, slope_upper = no_value, p = no_value;
};

/// Doses that are not negative (asserted). An ec50 needs three doses, 0 among them or not; a slope two above 0.
DoseResponse dose_response(std::span<const MeanAtDose> means, double level);

}  // namespace rheocyte
