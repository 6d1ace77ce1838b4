// Features of recordings as columns of numbers.
#pragma once
#include <vector>

#include "measurement/recording.h"

namespace rheocyte {

/// A stored feature of all events. UserError if there is none.
inline std::vector<double> column(const Recording& recording, const char* feature) {
  std::vector<double> values(recording.events());
  recording.read_scalar(feature, 0, values);
  return values;
}

}  // namespace rheocyte
