// Full 3 x 3 tensors of any scalar: double, or a dual number (ceres::Jet) when a derivative is wanted.
#pragma once
#include <ceres/jet.h>

#include <Eigen/Core>

namespace rheocyte {

template <class T>
using Tensor = Eigen::Matrix<T, 3, 3>;
template <class T>
using Vector = Eigen::Matrix<T, 3, 1>;

/// Components of a vector in the dimensions of a mesh, and their derivatives with respect to its coordinates.
template <class T, int dim>
using Components = Eigen::Matrix<T, dim, 1>;
template <class T, int dim>
using Slopes = Eigen::Matrix<T, dim, dim>;

template <class T>
T dot(const Vector<T>& a, const Vector<T>& b) {
  return a(0) * b(0) + a(1) * b(1) + a(2) * b(2);
}

template <class T>
Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {a(1) * b(2) - a(2) * b(1), a(2) * b(0) - a(0) * b(2), a(0) * b(1) - a(1) * b(0)};
}

template <class T>
T determinant(const Tensor<T>& A) {
  return A(0, 0) * (A(1, 1) * A(2, 2) - A(1, 2) * A(2, 1)) - A(0, 1) * (A(1, 0) * A(2, 2) - A(1, 2) * A(2, 0)) +
         A(0, 2) * (A(1, 0) * A(2, 1) - A(1, 1) * A(2, 0));
}

template <class T>
Tensor<T> inverse(const Tensor<T>& A) {
  const T scale = T(1) / determinant(A);
  Tensor<T> B;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      B(i, j) = (A(a, c) * A(b, d) - A(a, d) * A(b, c)) * scale;
    }
  }
  return B;
}

}  // namespace rheocyte
