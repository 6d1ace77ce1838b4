#include "numeric/density_maxima.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace rheocyte {
namespace {

constexpr std::size_t min_count = 100, places = 256;

struct Moments {
  double mean = 0, deviation = 0;
};

Moments moments_of(std::span<const double> values) {
  double mean = 0, squares = 0;
  for (const double v : values) mean += v / double(values.size());
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {mean, std::sqrt(squares / double(values.size() - 1))};
}

/// Counts in classes, from three bandwidths below the least value to as much above the greatest one.
struct Density {
  double start = 0, width = 0, bandwidth = 0, count = 0;
  std::array<double, places> at{};

  double place(std::size_t k) const { return start + (double(k) + 0.5) * width; }
  /// Of the estimate at a place, as of counts in a kernel's effective width.
  double error(std::size_t k) const { return std::sqrt(at[k] / (2 * std::sqrt(std::numbers::pi) * bandwidth * count)); }
};

Density density_of(std::span<const double> values, double deviation) {
  const auto [least, greatest] = std::ranges::minmax(values);
  Density d{.bandwidth = 1.06 * deviation * std::pow(double(values.size()), -0.2)};
  d.count = double(values.size());
  d.start = least - 3 * d.bandwidth;
  d.width = (greatest - least + 6 * d.bandwidth) / places;
  std::array<double, places> counts{};
  for (const double v : values) ++counts[std::min(std::size_t((v - d.start) / d.width), places - 1)];
  const double peak = 1 / (std::sqrt(2 * std::numbers::pi) * d.bandwidth * d.count);
  for (std::size_t k = 0; k < places; ++k)
    for (std::size_t j = 0; j < places; ++j) {
      const double distance = (double(k) - double(j)) * d.width / d.bandwidth;
      d.at[k] += peak * counts[j] * std::exp(-distance * distance / 2);
    }
  return d;
}

}  // namespace

DensityMaxima density_maxima(std::span<const double> values) {
  constexpr double min_depth = 0.25, min_errors = 4, min_fraction = 0.1;
  if (values.size() < min_count) return {};
  const Moments moments = moments_of(values);
  if (!(moments.deviation > 0)) return {};
  const Density d = density_of(values, moments.deviation);
  const auto highest = [&](std::size_t from, std::size_t until) {
    return std::size_t(std::max_element(d.at.begin() + std::ptrdiff_t(from), d.at.begin() + std::ptrdiff_t(until)) -
                       d.at.begin());
  };
  DensityMaxima deepest;
  double depth = min_depth;
  for (std::size_t k = 1; k + 1 < places; ++k) {
    if (d.at[k] > d.at[k - 1] || d.at[k] > d.at[k + 1]) continue;
    const std::size_t left = highest(0, k), right = highest(k + 1, places);
    const std::size_t lower_one = d.at[left] < d.at[right] ? left : right;
    const double drop = d.at[lower_one] - d.at[k];
    if (drop / d.at[lower_one] <= depth || drop < min_errors * std::hypot(d.error(k), d.error(lower_one))) continue;
    const auto below = std::ranges::count_if(values, [&](double v) { return v < d.place(k); });
    const double fraction = double(below) / double(values.size());
    if (fraction < min_fraction || fraction > 1 - min_fraction) continue;
    depth = drop / d.at[lower_one];
    deepest = {d.place(left), d.place(k), d.place(right), fraction};
  }
  return deepest;
}

}  // namespace rheocyte
