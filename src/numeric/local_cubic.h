// The cubic through four of many nodes of equal distance.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

namespace rheocyte {

/// Weights of the nodes first .. first + 3 at a place in units of their distance, 0 .. count - 1, and those of the
/// slope.
struct LocalCubic {
  int first;
  std::array<double, 4> value, slope;
};

inline LocalCubic local_cubic(double at, int count) {
  const int first = std::clamp(int(std::floor(at)) - 1, 0, count - 4);
  const double t = at - first, a = t - 1, b = t - 2, c = t - 3;
  return {first,
          {-a * b * c / 6, t * b * c / 2, -t * a * c / 2, t * a * b / 6},
          {-(a * b + a * c + b * c) / 6, (t * b + t * c + b * c) / 2, -(t * a + t * c + a * c) / 2,
           (t * a + t * b + a * b) / 6}};
}

}  // namespace rheocyte
