// Triangular systems with many right-hand sides at the speed of products of matrices.
#pragma once
#include <Eigen/Core>

namespace rheocyte {

/// columns <- U^-1 L^-1 columns, with both factors in one square matrix, the unit diagonal of L left out.
template <class Scalar>
void solve_triangular(const Eigen::MatrixX<Scalar>& factors, Eigen::MatrixX<Scalar>& columns);

}  // namespace rheocyte
