// Integrals over a hexahedron as sums over one direction after the other (sum factorisation): of degree p they cost
// (p+1)^6 operations instead of (p+1)^9 (docs/theory-square.md, eq:sums).
#pragma once
#include <array>

#include "fem/reference_element.h"

namespace rheocyte {

/// Applies a table (out x in) in each of the three directions to functions, one per column.
MatrixXd apply_in_each_direction(const MatrixXd& table, const MatrixXd& functions);
/// The same with a table for each direction.
MatrixXd apply_in_directions(const std::array<MatrixXd, 3>& tables, const MatrixXd& functions);

/// The values at other nodes of functions on an element, one per column; `table` is that of one direction.
template <int dim>
MatrixXd at_other_nodes(const MatrixXd& table, const MatrixXd& nodal) {
  if constexpr (dim == 3) {
    return apply_in_each_direction(table, nodal);
  } else {
    MatrixXd result(table.rows() * table.rows(), nodal.cols());
    for (Eigen::Index c = 0; c < nodal.cols(); ++c) {
      const MatrixXd values = table * nodal.col(c).reshaped(table.cols(), table.cols()) * table.transpose();
      result.col(c) = values.reshaped();
    }
    return result;
  }
}

/// The shape functions of a hexahedron, applied direction by direction. Numbers at points and nodes have the first
/// direction fastest; part 0 is the value, part k the derivative with respect to xi_k.
class TensorElement {
 public:
  explicit TensorElement(const ReferenceElement<3>&);

  int nodes_1d() const { return nodes_; }
  int points_1d() const { return points_; }

  /// A part of functions at the quadrature points from their values at the nodes, one per column.
  MatrixXd at_points(int part, const MatrixXd& nodal) const;
  /// Sums over the points of values (one function per column) times a part of each shape function: columns x nodes.
  MatrixXd tested(int part, const MatrixXd& at_points) const;

 private:
  friend class TensorTangent;
  int nodes_, points_;
  std::array<MatrixXd, 2> shape_;  ///< values and derivatives: points x nodes
  std::array<MatrixXd, 2> transposed_;
  /// Products of two of these tables, [first][second]: points x nodes^2, the first function's node fastest.
  std::array<std::array<Eigen::MatrixXf, 2>, 2> products_;
  Eigen::MatrixXf stacked_products_;  ///< all four below each other, [0][0], [1][0], [0][1], [1][1]
};

/// The matrices sum_q sum_km (part k of phi_i)(q) C_km(q) (part m of phi_j)(q) of pairs of components, in the precision
/// of NestedLU.
class TensorTangent {
 public:
  /// Coefficients at the points, nullptr where there are none: C[k][m].
  using Coefficients = std::array<std::array<const double*, 4>, 4>;
  void integrate(const TensorElement&, const Coefficients&);

  /// The entries of column (j1, j2, j3) in the rows (0, i2, i3), (1, i2, i3), ..., which are contiguous.
  const float* run(int i2, int i3, int j1, int j2, int j3) const {
    const int n = nodes_;
    return result_.data() + n * (j1 + n * ((i2 + n * j2) + n * n * (i3 + n * j3)));
  }

 private:
  static void sum_third(const TensorElement&, const Coefficients&, int row_kind, int column_kind,
                        Eigen::MatrixXf& sums);

  int nodes_ = 0;
  Eigen::MatrixXf third_, second_, result_;
};

}  // namespace rheocyte
