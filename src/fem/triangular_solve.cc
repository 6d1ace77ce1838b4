#include "fem/triangular_solve.h"

#include <algorithm>

namespace rheocyte {
namespace {

using Eigen::Index;

/// Rows that are solved at once by the inverse of their block of the diagonal. Substitution row by row would take a
/// third of the operations and twice the time.
constexpr Index rows_at_once = 32;

template <unsigned part, class Matrix>
Matrix inverses_of_blocks(const Matrix& factors) {
  const Index n = factors.rows();
  Matrix inverses = Matrix::Zero(std::min(rows_at_once, n), n);
  for (Index from = 0; from < n; from += rows_at_once) {
    const Index size = std::min(rows_at_once, n - from);
    auto inverse = inverses.block(0, from, size, size);
    inverse.setIdentity();
    factors.block(from, from, size, size).template triangularView<part>().solveInPlace(inverse);
  }
  return inverses;
}

}  // namespace

template <class Scalar>
TriangularFactors<Scalar>::TriangularFactors(const Matrix& factors)
    : factors_(factors),
      inverse_lower_(inverses_of_blocks<Eigen::UnitLower>(factors)),
      inverse_upper_(inverses_of_blocks<Eigen::Upper>(factors)) {}

template <class Scalar>
void TriangularFactors<Scalar>::solve_in_place(Eigen::Ref<Matrix> columns) const {
  const Index n = factors_.rows();
  Matrix solved;
  for (Index from = 0; from < n; from += rows_at_once) {
    const Index size = std::min(rows_at_once, n - from), rest = n - from - size;
    solved.noalias() = inverse_lower_.block(0, from, size, size) * columns.middleRows(from, size);
    columns.middleRows(from, size) = solved;
    columns.bottomRows(rest).noalias() -= factors_.block(from + size, from, rest, size) * solved;
  }
  for (Index end = n; end > 0; end = (end - 1) / rows_at_once * rows_at_once) {
    const Index from = (end - 1) / rows_at_once * rows_at_once, size = end - from;
    solved.noalias() = inverse_upper_.block(0, from, size, size) * columns.middleRows(from, size);
    columns.middleRows(from, size) = solved;
    columns.topRows(from).noalias() -= factors_.block(0, from, from, size) * solved;
  }
}

template class TriangularFactors<float>;
template class TriangularFactors<double>;

}  // namespace rheocyte
