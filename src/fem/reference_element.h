// Shape functions of the reference element [0,1]^2, tabulated at the points of a quadrature rule.
#pragma once
#include <Eigen/Core>

namespace rheocyte {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Values and both derivatives of some functions: `points` x `functions` each.
struct ShapeTable {
  MatrixXd value, d1, d2;
};

/// Q_p on Gauss-Lobatto nodes and P_{p-1} (orthonormal Legendre modes of total degree < p, the constant first) at the
/// (p+2)^2 Gauss points; first coordinate fastest throughout.
class ReferenceElement {
 public:
  explicit ReferenceElement(int degree);

  int degree() const { return degree_; }
  int nodes() const { return (degree_ + 1) * (degree_ + 1); }
  int pressures() const { return degree_ * (degree_ + 1) / 2; }
  int points() const { return int(weights.size()); }
  bool is_interior(int node) const;

  VectorXd nodes_1d, points_1d, weights_1d;  ///< on [0,1]
  VectorXd weights;
  ShapeTable shape;
  MatrixXd shape_stack;  ///< value, d1, d2 of `shape` below each other
  ShapeTable pressure;   ///< values only

  /// Values of the 1D Lagrange functions of the nodes at given points in [0,1]: points x (p+1).
  MatrixXd lagrange(const VectorXd& at) const;
  /// Their derivatives.
  MatrixXd lagrange_derivative(const VectorXd& at) const;
  /// Value at a point of the Q_p function with the given nodal values.
  double interpolate(const VectorXd& nodal, double xi1, double xi2) const;
  /// Values of the pressure modes at one point.
  VectorXd pressure_modes(double xi1, double xi2) const;

 private:
  int degree_;
};

}  // namespace rheocyte
