// What tests read of a recording.
#pragma once
#include <string>
#include <vector>

#include "measurement/recording.h"

namespace rheocyte::test {

/// A scalar feature of all events.
inline std::vector<double> column(const Recording& recording, const std::string& feature) {
  std::vector<double> values(recording.events());
  recording.read_scalar(feature, 0, values);
  return values;
}

inline bool remarks_contain(const Recording& recording, const std::string& words) {
  for (const auto& remark : recording.remarks())
    if (remark.find(words) != std::string::npos) return true;
  return false;
}

}  // namespace rheocyte::test
