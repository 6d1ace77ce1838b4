#include "fem/triangular_solve.h"

#include <algorithm>

namespace rheocyte {
namespace {

using Eigen::Index;

/// Rows that are solved at once by the inverse of their block of the diagonal. Substitution row by row would take a
/// third of the operations and twice the time.
constexpr Index rows_at_once = 32;

template <unsigned part, class Matrix>
Matrix inverse_of_block(const Matrix& factors, Index from, Index size) {
  Matrix inverse = Matrix::Identity(size, size);
  factors.block(from, from, size, size).template triangularView<part>().solveInPlace(inverse);
  return inverse;
}

}  // namespace

template <class Scalar>
void solve_triangular(const Eigen::MatrixX<Scalar>& factors, Eigen::MatrixX<Scalar>& columns) {
  using Matrix = Eigen::MatrixX<Scalar>;
  const Index n = factors.rows();
  Matrix solved;
  for (Index from = 0; from < n; from += rows_at_once) {
    const Index size = std::min(rows_at_once, n - from), rest = n - from - size;
    solved.noalias() = inverse_of_block<Eigen::UnitLower>(factors, from, size) * columns.middleRows(from, size);
    columns.middleRows(from, size) = solved;
    columns.bottomRows(rest).noalias() -= factors.block(from + size, from, rest, size) * solved;
  }
  for (Index end = n; end > 0; end = (end - 1) / rows_at_once * rows_at_once) {
    const Index from = (end - 1) / rows_at_once * rows_at_once, size = end - from;
    solved.noalias() = inverse_of_block<Eigen::Upper>(factors, from, size) * columns.middleRows(from, size);
    columns.middleRows(from, size) = solved;
    columns.topRows(from).noalias() -= factors.block(0, from, from, size) * solved;
  }
}

template void solve_triangular(const Eigen::MatrixXf&, Eigen::MatrixXf&);
template void solve_triangular(const Eigen::MatrixXd&, Eigen::MatrixXd&);

}  // namespace rheocyte
