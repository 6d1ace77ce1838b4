// Quantiles of samples.
#pragma once
#include <algorithm>
#include <limits>
#include <span>
#include <vector>

namespace rheocyte {

/// Of ascending numbers, at least one, linear between them.
inline double quantile(std::span<const double> sorted, double fraction) {
  const double place = fraction * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

/// The middle one, of an even number the upper one of the two; reorders the numbers. NaN of none.
template <class Number>
double median_of(std::vector<Number>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace rheocyte
