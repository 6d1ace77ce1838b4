// Triangular systems with many right-hand sides at the speed of products of matrices.
#pragma once
#include <Eigen/Core>

namespace rheocyte {

/// Both factors of a square matrix, L and U, in one, the unit diagonal of L left out.
template <class Scalar>
class TriangularFactors {
 public:
  using Matrix = Eigen::MatrixX<Scalar>;

  /// The matrix must outlive this object.
  explicit TriangularFactors(const Matrix& factors);

  /// columns <- U^-1 L^-1 columns.
  void solve_in_place(Eigen::Ref<Matrix> columns) const;

 private:
  const Matrix& factors_;
  Matrix inverse_lower_, inverse_upper_;  ///< of the blocks of the diagonal, side by side
};

}  // namespace rheocyte
