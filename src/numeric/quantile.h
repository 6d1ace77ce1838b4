// Quantiles of samples.
#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "numeric/no_value.h"

namespace rheocyte {

/// Linear between two of the numbers, at least one; reorders them. As fast as reading them some times: none is sorted.
inline double quantile(std::span<double> values, double fraction) {
  const double place = fraction * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const auto lower = values.begin() + static_cast<std::ptrdiff_t>(below);
  std::ranges::nth_element(values, lower);
  const double above = lower + 1 == values.end() ? *lower : *std::min_element(lower + 1, values.end());
  return *lower + (place - static_cast<double>(below)) * (above - *lower);
}

/// The middle one, of an even number the upper one of the two; reorders the numbers. NaN of none.
template <class Number>
double median_of(std::vector<Number>& values) {
  if (values.empty()) return no_value;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace rheocyte
