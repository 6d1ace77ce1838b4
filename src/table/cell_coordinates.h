// The coordinates of a combined cell, and functions of them.
#pragma once
#include <Eigen/Core>

namespace rheocyte {

/// The coordinates of a cell. One of them is its progress along a branch. It is the deformation: all branches reach the
/// same deformations and turn back at none, and states of equal deformation change least from branch to branch. Of a
/// table of elongated cells, which have a deformation without flow, it is the third mode that the cell would have
/// without the axial tension if this mode grew in proportion to 1 / S all along the branch: branches of all tensions
/// end at similar stiffnesses.
inline constexpr int x_radius = 0,                ///< ln(r0 / um)
    x_fraction = 1,                               ///< of the cortex in S
    x_progress = 2,                               ///< its logarithm
    x_ratio = 3,                                  ///< tension of the cortex over its modulus
    x_axial = 4, coordinate_count = x_axial + 1;  ///< axial tension over S
using CellCoordinates = Eigen::Matrix<double, coordinate_count, 1>;

/// A number with its derivatives.
struct CellFunction {
  double value = 0;
  CellCoordinates gradient = CellCoordinates::Zero();

  CellFunction operator*(const CellFunction& other) const {
    return {value * other.value, value * other.gradient + other.value * gradient};
  }
  CellFunction operator+(const CellFunction& other) const { return {value + other.value, gradient + other.gradient}; }
  /// 1 - this.
  CellFunction complement() const { return {1 - value, -gradient}; }
};

}  // namespace rheocyte
