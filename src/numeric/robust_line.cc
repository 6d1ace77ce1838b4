#include "numeric/robust_line.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "numeric/quantile.h"

namespace rheocyte {

namespace {

constexpr double huber = 1.345, bisquare = 4.685;  // 95 % of the precision of least squares, each
constexpr double deviations_per_median = 1.4826;   // of the absolute values of a normal distribution
constexpr int iterations = 25;                     // errors fall to a third, or faster, with each

/// Points, and how much each counts.
struct Weighted {
  std::vector<double> x, y, weight;
};

/// Weighted least squares.
struct Line {
  double slope = 0, middle_x = 0, middle_y = 0, square = 0;  ///< square: sum of weights times (x - middle_x)^2

  double rest(double x, double y) const { return y - middle_y - slope * (x - middle_x); }
};

Line least_squares(const Weighted& points) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    n += points.weight[i];
    x += points.weight[i] * points.x[i];
    y += points.weight[i] * points.y[i];
  }
  x /= n, y /= n;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const double dx = points.x[i] - x;
    xx += points.weight[i] * dx * dx;
    xy += points.weight[i] * dx * (points.y[i] - y);
  }
  return {xy / xx, x, y, xx};
}

/// Robust standard deviation about the line.
double scale_of(const Weighted& points, const Line& line) {
  std::vector<double> rests(points.x.size());
  for (std::size_t i = 0; i < rests.size(); ++i) rests[i] = std::abs(line.rest(points.x[i], points.y[i]));
  return deviations_per_median * median_of(rests);
}

double huber_weight(double z) { return std::abs(z) <= huber ? 1 : huber / std::abs(z); }

double bisquare_weight(double z) {
  const double fraction = z / bisquare;
  return std::abs(fraction) < 1 ? (1 - fraction * fraction) * (1 - fraction * fraction) : 0;
}

/// d (z weight) / dz of the bisquare.
double bisquare_slope(double z) {
  const double square = z * z / (bisquare * bisquare);
  return square < 1 ? (1 - square) * (1 - 5 * square) : 0;
}

/// Of one observation about the line, in place of the standard deviation of least squares.
double effective_deviation(const Weighted& points, const Line& line, double scale) {
  const auto n = static_cast<double>(points.x.size());
  double squares = 0, slope = 0, slopes_squared = 0;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const double z = line.rest(points.x[i], points.y[i]) / scale, psi = z * bisquare_weight(z), d = bisquare_slope(z);
    squares += psi * psi;
    slope += d / n;
    slopes_squared += d * d / n;
  }
  const double small_sample = 1 + 2 / n * (slopes_squared - slope * slope) / (slope * slope);
  return small_sample * scale * std::sqrt(squares / (n - 2)) / slope;
}

Weighted finite(std::span<const double> x, std::span<const double> y) {
  Weighted points;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) continue;
    points.x.push_back(x[i]);
    points.y.push_back(y[i]);
  }
  points.weight.assign(points.x.size(), 1);
  return points;
}

}  // namespace

RobustLine robust_line(std::span<const double> x, std::span<const double> y) {
  Weighted points = finite(x, y);
  const std::size_t n = points.x.size();
  if (n < 3) return {{}, {}, no_value, n};
  const double square = least_squares(points).square, middle_x = least_squares(points).middle_x;
  if (!(square > 0)) return {{}, {}, no_value, n};
  double scale = 0;
  for (const auto weight : {huber_weight, bisquare_weight}) {
    for (int k = 0; k < iterations; ++k) {
      const Line line = least_squares(points);
      scale = scale_of(points, line);
      if (!(scale > 0)) break;  // at least half of the points lie on the line
      for (std::size_t i = 0; i < n; ++i) points.weight[i] = weight(line.rest(points.x[i], points.y[i]) / scale);
    }
  }
  const Line line = least_squares(points);
  const double middle = line.middle_y + line.slope * (middle_x - line.middle_x);
  const double deviation = scale > 0 ? effective_deviation(points, line, scale) : 0;
  return {{line.slope, deviation / std::sqrt(square)},
          {middle, deviation / std::sqrt(static_cast<double>(n))},
          middle_x,
          n};
}

}  // namespace rheocyte
