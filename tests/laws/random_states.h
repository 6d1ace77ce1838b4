// Random states at a point, the same in every run.
#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>

#include "laws/axisymmetric.h"

namespace rheocyte::test {

/// States per law (R1 of the promises: 1,000).
inline constexpr int states = 1000;

inline Tensor<double> diagonal(double x, double y, double z) { return {x, 0, 0, 0, y, 0, 0, 0, z}; }

class RandomStates {
 public:
  double number(double low, double high) { return std::uniform_real_distribution(low, high)(engine_); }

  /// Entries in [-size, size].
  Tensor<double> tensor(double size) {
    Tensor<double> A;
    for (double& entry : A.entries) entry = number(-size, size);
    return A;
  }

  Tensor<double> rotation() {
    const Eigen::Vector3d axis = Eigen::Vector3d::NullaryExpr([&] { return number(-1, 1); }).normalized();
    return Eigen::AngleAxisd(number(-3, 3), axis).toRotationMatrix();
  }

  Tensor<double> spin() {
    const Tensor<double> A = tensor(1);
    return A - A.transpose();
  }

  Tensor<double> trace_free(double size) {
    Tensor<double> A = tensor(size);
    A -= Tensor<double>::Identity() * (A.trace() / 3);
    return A;
  }

  /// A deformation gradient far from singular: off-diagonal entries below 0.3.
  Tensor<double> deformation_gradient() { return Tensor<double>::Identity() + tensor(0.3); }

  /// The same with det F = 1.
  Tensor<double> isochoric() {
    const Tensor<double> F = deformation_gradient();
    return F / std::cbrt(determinant(F));
  }

  /// d(x, r)/d(xi) of an element that is not folded.
  Slopes<double, 2> element_map() { return {number(0.5, 1.5), number(-0.3, 0.3), number(-0.3, 0.3), number(0.5, 1.5)}; }

  PointMap<double, 2> map() {
    const Slopes<double, 2> G = element_map();
    return PointMap<double, 2>({G, number(0.2, 1)});
  }

 private:
  std::mt19937 engine_{20240229};
};

}  // namespace rheocyte::test
