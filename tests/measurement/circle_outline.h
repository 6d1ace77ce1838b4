// A circle as an outline in pixels.
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <numbers>

namespace rheocyte::test {

inline Eigen::MatrixX2d circle(double x, double y, double radius) {
  using std::numbers::pi;
  constexpr int points = 720;
  Eigen::MatrixX2d outline(points, 2);
  for (int i = 0; i < points; ++i)
    outline.row(i) << x + radius * std::cos(2 * pi * i / points), y + radius * std::sin(2 * pi * i / points);
  return outline;
}

}  // namespace rheocyte::test
