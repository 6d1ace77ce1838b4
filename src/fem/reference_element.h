// Shape functions of the reference element [0,1]^dim, tabulated at the points of a quadrature rule.
#pragma once
#include <Eigen/Core>
#include <array>

namespace rheocyte {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Values of some functions and their derivatives with respect to each coordinate: `points` x `functions` each.
template <int dim>
struct ShapeTable {
  MatrixXd value;
  std::array<MatrixXd, dim> slope;

  /// The values (0) or the derivatives with respect to xi_part.
  const MatrixXd& part(int part) const { return part == 0 ? value : slope[part - 1]; }
};

/// Q_p on Gauss-Lobatto nodes and P_{p-1} (orthonormal Legendre modes of total degree < p, the constant first) at
/// Gauss points; first coordinate fastest throughout. For two and three dimensions.
template <int dim>
class ReferenceElement {
 public:
  using Coordinates = Eigen::Matrix<double, dim, 1>;

  /// With p+2 Gauss points in each direction.
  explicit ReferenceElement(int degree) : ReferenceElement(degree, degree + 2) {}
  ReferenceElement(int degree, int number_1d);

  int degree() const { return degree_; }
  int nodes() const { return int(shape.value.cols()); }
  int pressures() const { return int(pressure.value.cols()); }
  int points() const { return int(weights.size()); }
  bool is_interior(int node) const;

  VectorXd nodes_1d, points_1d, weights_1d;  ///< on [0,1]
  VectorXd weights;
  ShapeTable<dim> shape;
  MatrixXd shape_stack;      ///< the parts of `shape` below each other
  ShapeTable<dim> pressure;  ///< values only
  /// Products of two of the 1D functions at the 1D points, the first function fastest: values of both, derivatives of
  /// the first, of the second, of both, below each other.
  MatrixXd products_1d;
  /// Products of one of the 1D functions, which is fastest, and a 1D Legendre mode: values, and below them those with
  /// the function's derivative.
  MatrixXd mode_products_1d;

  /// Values of the 1D Lagrange functions of the nodes at given points in [0,1]: points x (p+1).
  MatrixXd lagrange(const VectorXd& at) const;
  /// Their derivatives.
  MatrixXd lagrange_derivative(const VectorXd& at) const;
  /// Nodal values of the 1D polynomials that fit values at the 1D quadrature points best: (p+1) x points.
  MatrixXd points_to_nodes() const;
  /// Value at a point of the Q_p function with the given nodal values.
  double interpolate(const VectorXd& nodal, const Coordinates& xi) const;
  /// Values of the pressure modes at one point.
  VectorXd pressure_modes(const Coordinates& xi) const;

 private:
  int degree_;
};

}  // namespace rheocyte
