// Features of recordings as columns of numbers.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "measurement/recording.h"

namespace rheocyte {

/// A stored feature of all events. UserError if there is none.
inline std::vector<double> column(const Recording& recording, const char* feature) {
  std::vector<double> values(recording.events());
  recording.read_scalar(feature, 0, values);
  return values;
}

/// The number below which this share of the values lies; NaN of none.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return NAN;
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

}  // namespace rheocyte
