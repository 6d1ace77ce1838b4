#include "numeric/compiled_products.h"

#include <algorithm>

namespace rheocyte {
namespace {

/// Below this sum of sizes Eigen does not arrange its factors for the kernels either.
constexpr Eigen::Index small = EIGEN_GEMM_TO_COEFFBASED_THRESHOLD;

template <class Scalar, int order>
using Dense = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, order>;
template <class Scalar, int order>
using Map = Eigen::Map<const Dense<Scalar, order>, 0, Eigen::OuterStride<>>;
template <class Scalar>
using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

template <int order, class Scalar>
Map<Scalar, order> map_of(const MatrixInMemory<Scalar>& a) {
  return {a.data, a.rows, a.columns, Eigen::OuterStride<>(a.stride)};
}

/// c += scale a b by Eigen's kernels.
template <int order_a, int order_b, class Scalar>
void add_large(const MatrixInMemory<Scalar>& a, const MatrixInMemory<Scalar>& b, Scalar scale, Scalar* c,
               Eigen::Index stride) {
  using namespace Eigen::internal;
  gemm_blocking_space<Eigen::ColMajor, Scalar, Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::Dynamic> blocking(
      a.rows, b.columns, a.columns, 1, true);
  general_matrix_matrix_product<Eigen::Index, Scalar, order_a, false, Scalar, order_b, false, Eigen::ColMajor, 1>::run(
      a.rows, b.columns, a.columns, a.data, a.stride, b.data, b.stride, c, 1, stride, scale, blocking, nullptr);
}

template <int order_a, int order_b, class Scalar>
void add_product(const MatrixInMemory<Scalar>& a, const MatrixInMemory<Scalar>& b, Scalar scale, Scalar* c,
                 Eigen::Index stride) {
  const auto A = map_of<order_a>(a);
  const auto B = map_of<order_b>(b);
  if (b.columns == 1) {
    const Vector<Scalar> column = B.col(0);
    Eigen::Map<Vector<Scalar>>(c, a.rows).noalias() += scale * (A * column);
  } else if (a.rows + b.rows + b.columns < small || a.rows == 1) {
    Eigen::Map<Dense<Scalar, Eigen::ColMajor>, 0, Eigen::OuterStride<>>(
        c, a.rows, b.columns, Eigen::OuterStride<>(stride)) += scale * A.lazyProduct(B);
  } else {
    add_large<order_a, order_b>(a, b, scale, c, stride);
  }
}

}  // namespace

template <class Scalar>
void multiply(const MatrixInMemory<Scalar>& a, const MatrixInMemory<Scalar>& b, Scalar scale, bool overwrites,
              Scalar* c, Eigen::Index stride) {
  if (overwrites) {
    for (Eigen::Index j = 0; j < b.columns; ++j) std::fill_n(c + stride * j, a.rows, Scalar(0));
  }
  if (a.rows == 0 || b.columns == 0 || a.columns == 0) return;
  constexpr int columns = Eigen::ColMajor, rows = Eigen::RowMajor;
  if (a.by_rows) {
    b.by_rows ? add_product<rows, rows>(a, b, scale, c, stride) : add_product<rows, columns>(a, b, scale, c, stride);
  } else {
    b.by_rows ? add_product<columns, rows>(a, b, scale, c, stride)
              : add_product<columns, columns>(a, b, scale, c, stride);
  }
}

template void multiply(const MatrixInMemory<double>&, const MatrixInMemory<double>&, double, bool, double*,
                       Eigen::Index);
template void multiply(const MatrixInMemory<float>&, const MatrixInMemory<float>&, float, bool, float*, Eigen::Index);

}  // namespace rheocyte
