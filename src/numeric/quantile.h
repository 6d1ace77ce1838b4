// Quantiles of samples.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "numeric/no_value.h"

namespace rheocyte {

/// The numbers of places `place` and `place + 1` (or the last one twice) in the order of size, without sorting: they
/// are counted in classes of equal width, and only the classes of these places are looked at. No NaN, the place in
/// range.
template <class Number>
std::pair<double, double> neighbours_in_order(std::span<const Number> values, std::size_t place) {
  constexpr std::size_t classes = 2048;
  const auto [min, max] = std::ranges::minmax(values);
  const double width = (double(max) - double(min)) / classes, start = double(min);
  if (!(width > 0)) return {start, start};
  const auto class_of = [&](Number value) {
    const double place_of_class = (double(value) - start) / width;
    return place_of_class < classes - 1 ? std::size_t(place_of_class) : classes - 1;  // also what is infinite
  };
  std::array<std::size_t, classes> counts{};
  for (const Number value : values) ++counts[class_of(value)];
  const std::size_t next = std::min(place + 1, values.size() - 1);
  std::size_t first = 0, before = 0;
  while (before + counts[first] <= place) before += counts[first++];
  std::size_t last = first, until = before + counts[first];
  while (until <= next) until += counts[++last];
  std::vector<Number> near;
  near.reserve(until - before);
  for (const Number value : values)
    if (const std::size_t its = class_of(value); first <= its && its <= last) near.push_back(value);
  std::ranges::nth_element(near, near.begin() + std::ptrdiff_t(place - before));
  const double here = near[place - before];
  if (next == place) return {here, here};
  return {here, *std::min_element(near.begin() + std::ptrdiff_t(next - before), near.end())};
}

/// Linear between two of the numbers, at least one.
inline double quantile(std::span<const double> values, double fraction) {
  const double place = fraction * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const auto [lower, above] = neighbours_in_order(values, below);
  return lower + (place - static_cast<double>(below)) * (above - lower);
}

/// The middle one, of an even number the upper one of the two. NaN of none.
template <class Number>
double median_of(const std::vector<Number>& values) {
  if (values.empty()) return no_value;
  return neighbours_in_order(std::span<const Number>(values), values.size() / 2).first;
}

}  // namespace rheocyte
