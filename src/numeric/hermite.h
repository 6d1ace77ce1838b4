// The cubic through two values with two slopes.
#pragma once

namespace rheocyte {

/// Weights of the values and slopes at the ends of an interval at a place of it, 0 .. 1; slopes per interval.
struct HermiteWeights {
  double first, last, first_slope, last_slope;

  template <class Value>
  auto operator()(const Value& a, const Value& b, const Value& slope_a, const Value& slope_b) const {
    return first * a + last * b + first_slope * slope_a + last_slope * slope_b;
  }
};

inline HermiteWeights hermite(double t) {
  const double s = 1 - t;
  return {s * s * (1 + 2 * t), t * t * (3 - 2 * t), s * s * t, -s * t * t};
}

/// Of the derivative, per interval.
inline HermiteWeights hermite_slope(double t) {
  const double s = 1 - t;
  return {-6 * t * s, 6 * t * s, s * (1 - 3 * t), t * (3 * t - 2)};
}

}  // namespace rheocyte
