// Quantiles and means of samples.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "numeric/no_value.h"

namespace rheocyte {

/// Numbers that are counted once, in classes of equal width; places in their order of size are then found without
/// sorting, because only the classes of these places are looked at. At least one number, none of them NaN; the span
/// outlives this.
template <class Number>
class CountedSample {
 public:
  explicit CountedSample(std::span<const Number> values) : values_(values), class_(values.size()) {
    const auto [min, max] = std::ranges::minmax(values);
    start_ = double(min);
    per_class_ = classes / (double(max) - start_);
    is_constant_ = !(max > min);
    if (is_constant_) return;
    for (std::size_t i = 0; i < values.size(); ++i) ++counts_[class_[i] = class_of(values[i])];
  }

  std::size_t count() const { return values_.size(); }

  /// The numbers of places `place` and `place + 1` (or the last one twice) in the order of size; the place in range.
  std::pair<double, double> neighbours(std::size_t place) const {
    if (is_constant_) return {start_, start_};
    const std::size_t next = std::min(place + 1, values_.size() - 1);
    std::size_t first = 0, before = 0;
    while (before + counts_[first] <= place) before += counts_[first++];
    std::size_t last = first, until = before + counts_[first];
    while (until <= next) until += counts_[++last];
    std::vector<Number> near;
    near.reserve(until - before);
    collect(std::uint16_t(first), std::uint16_t(last), near);
    std::ranges::nth_element(near, near.begin() + std::ptrdiff_t(place - before));
    const double here = near[place - before];
    if (next == place) return {here, here};
    return {here, *std::min_element(near.begin() + std::ptrdiff_t(next - before), near.end())};
  }

  /// Linear between two of the numbers.
  double quantile(double fraction) const {
    const double place = fraction * static_cast<double>(values_.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const auto [lower, above] = neighbours(below);
    return lower + (place - static_cast<double>(below)) * (above - lower);
  }

 private:
  static constexpr std::size_t classes = 2048;

  std::uint16_t class_of(Number value) const {
    const double place = (double(value) - start_) * per_class_;
    return std::uint16_t(place < classes - 1 ? place : classes - 1);  // also what is infinite
  }

  // Most stretches hold none of these classes, which the processor sees for many numbers at once.
  void collect(std::uint16_t first, std::uint16_t last, std::vector<Number>& found) const {
    constexpr std::size_t stretch = 128;
    const auto is_meant = [first, last](std::uint16_t c) { return first <= c && c <= last; };
    for (std::size_t start = 0; start < class_.size(); start += stretch) {
      const std::size_t end = std::min(start + stretch, class_.size());
      std::uint16_t count = 0;
      for (std::size_t i = start; i < end; ++i) count = std::uint16_t(count + is_meant(class_[i]));
      for (std::size_t i = start; count > 0 && i < end; ++i)
        if (is_meant(class_[i])) found.push_back(values_[i]);
    }
  }

  std::span<const Number> values_;
  double start_ = 0, per_class_ = 0;
  bool is_constant_ = false;
  std::vector<std::uint16_t> class_;  // of each number
  std::array<std::size_t, classes> counts_{};
};

/// Linear between two of the numbers. NaN of none.
inline double quantile(std::span<const double> values, double fraction) {
  return values.empty() ? no_value : CountedSample(values).quantile(fraction);
}

/// How far the 5 % and the 95 % quantile lie apart: where most are, whatever the outliers do. NaN of none.
inline double central_width(std::span<const double> values) {
  if (values.empty()) return no_value;
  const CountedSample sample(values);
  return sample.quantile(0.95) - sample.quantile(0.05);
}

/// Standard deviation of the normal distribution that has these quartiles: outliers hardly move it.
template <class Number>
double robust_deviation(const CountedSample<Number>& sample) {
  constexpr double per_quartile = 0.6745;
  return (sample.quantile(0.75) - sample.quantile(0.25)) / (2 * per_quartile);
}

/// Quartiles of fewer numbers do not determine their scatter.
inline constexpr std::size_t min_count_of_scatter = 5;

/// Standard error of the median, from that: sqrt(pi / 2) times the one of a mean. NaN of fewer than five numbers.
template <class Number>
double error_of_median(const CountedSample<Number>& sample) {
  return sample.count() >= min_count_of_scatter
             ? 1.25 * robust_deviation(sample) / std::sqrt(static_cast<double>(sample.count()))
             : no_value;
}

/// The middle one, of an even number the upper one of the two. NaN of none.
template <class Number>
double median_of(const std::vector<Number>& values) {
  if (values.empty()) return no_value;
  return CountedSample(std::span<const Number>(values)).neighbours(values.size() / 2).first;
}

/// NaN of no numbers.
inline double mean_of(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace rheocyte
