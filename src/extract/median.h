// A median with its errors.
#pragma once
#include <tuple>
#include <vector>

#include "numeric/no_value.h"

namespace rheocyte {

/// Median and its standard error, 1.25 robust sigma / sqrt(n); NaN without values.
struct Median {
  double value = no_value, error = no_value;
  double common_error = no_value;  ///< by what all events share (common_errors.h), where that is known

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.value, s.error, s.common_error);
  }
};

/// 1.25 robust sigma / sqrt(n) beside the median of the finite values; NaN where there are too few.
Median median_with_error(std::vector<double> values);

}  // namespace rheocyte
