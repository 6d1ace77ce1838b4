// What a mesh that follows a cell is judged by, at a point (docs/theory.md, eq:distortion).
#pragma once
#include <cmath>

#include "laws/tensor.h"

namespace rheocyte {

template <class T>
T determinant(const Matrix<T, 2, 2>& F) {
  return F(0, 0) * F(1, 1) - F(0, 1) * F(1, 0);
}

/// Distortion of a map with derivatives F, the square of the inverse mean ratio |F|^2 / (dim det F^(2 / dim)): 1 where
/// the map is a similarity, infinite where it folds.
template <class T, int dim>
T distortion(const Matrix<T, dim, dim>& F) {
  using std::pow;
  T squares = F(0) * F(0);
  for (int i = 1; i < dim * dim; ++i) squares += F(i) * F(i);
  T size = determinant(F);
  if constexpr (dim == 3) size = pow(size, 2.0 / 3);
  const T ratio = squares * constant<T>(1.0 / dim) / size;
  return ratio * ratio;
}

}  // namespace rheocyte
