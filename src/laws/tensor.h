// Vectors and tensors of any scalar: double, or a dual number when a derivative is requested. They are written out
// because a point has many of them and the compiler would spend most of its time on Eigen's expressions of dual
// numbers.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>

#include "laws/dual.h"

namespace rheocyte {

template <class T, int rows, int columns = 1>
struct Matrix;
template <class T, int rows, int columns>
T dot(const Matrix<T, rows, columns>&, const Matrix<T, rows, columns>&);

/// What entries of type T can be multiplied by.
template <class S, class T>
concept ScalarOf = std::is_same_v<S, T> || std::is_arithmetic_v<S>;

/// A small matrix, or a vector (columns = 1). Members are called as those of Eigen's matrices.
template <class T, int row_count, int column_count>
struct Matrix {
  using Scalar = T;
  std::array<T, std::size_t(row_count* column_count)> entries;  ///< column by column

  Matrix() = default;
  /// From its entries, row by row.
  template <class... Entries>
  requires(sizeof...(Entries) == row_count * column_count && sizeof...(Entries) > 1) Matrix(const Entries&... by_rows) {
    int i = 0;
    ((entries[i % column_count * row_count + i / column_count] = by_rows, ++i), ...);
  }
  explicit Matrix(const std::array<T, std::size_t(row_count* column_count)>& by_columns) : entries(by_columns) {}
  template <class Derived>
  requires std::is_same_v<T, double> Matrix(const Eigen::MatrixBase<Derived>& numbers) {
    Eigen::Map<Eigen::Matrix<double, row_count, column_count>>(entries.data()) = numbers;
  }
  static Matrix Zero() {
    Matrix zero;
    zero.entries.fill(constant<T>(0));
    return zero;
  }
  static Matrix Identity() {
    Matrix identity = Zero();
    for (int i = 0; i < row_count; ++i) identity(i, i) = constant<T>(1);
    return identity;
  }

  static constexpr int rows() { return row_count; }
  static constexpr int cols() { return column_count; }
  static constexpr int size() { return row_count * column_count; }
  T& operator()(int i) { return entries[std::size_t(i)]; }
  const T& operator()(int i) const { return entries[std::size_t(i)]; }
  T& operator()(int i, int j) { return entries[std::size_t(i + row_count * j)]; }
  const T& operator()(int i, int j) const { return entries[std::size_t(i + row_count * j)]; }

  Eigen::Map<const Eigen::Matrix<double, row_count, column_count>> eigen() const {
    return Eigen::Map<const Eigen::Matrix<double, row_count, column_count>>(entries.data());
  }
  template <class S>
  Matrix<S, row_count, column_count> cast() const {
    Matrix<S, row_count, column_count> result;
    for (int i = 0; i < size(); ++i) result(i) = S((*this)(i));
    return result;
  }
  Matrix<T, column_count, row_count> transpose() const {
    Matrix<T, column_count, row_count> result;
    for (int i = 0; i < row_count; ++i) {
      for (int j = 0; j < column_count; ++j) result(j, i) = (*this)(i, j);
    }
    return result;
  }
  T trace() const {
    T sum = entries[0];
    for (int i = 1; i < row_count; ++i) sum += (*this)(i, i);
    return sum;
  }
  T squaredNorm() const { return dot(*this, *this); }
  T norm() const {
    using std::sqrt;
    return sqrt(squaredNorm());
  }

  Matrix& operator+=(const Matrix& b) { return *this = *this + b; }
  Matrix& operator-=(const Matrix& b) { return *this = *this - b; }
  friend Matrix operator+(const Matrix& a, const Matrix& b) {
    Matrix sum;
    for (int i = 0; i < size(); ++i) sum(i) = a(i) + b(i);
    return sum;
  }
  friend Matrix operator-(const Matrix& a, const Matrix& b) {
    Matrix difference;
    for (int i = 0; i < size(); ++i) difference(i) = a(i) - b(i);
    return difference;
  }
  friend Matrix operator-(const Matrix& a) {
    Matrix opposite;
    for (int i = 0; i < size(); ++i) opposite(i) = -a(i);
    return opposite;
  }
  template <ScalarOf<T> S>
  friend Matrix operator*(const Matrix& a, const S& factor) {
    Matrix product;
    for (int i = 0; i < size(); ++i) product(i) = a(i) * factor;
    return product;
  }
  template <ScalarOf<T> S>
  friend Matrix operator*(const S& factor, const Matrix& a) {
    return a * factor;
  }
  friend Matrix operator/(const Matrix& a, const T& divisor) { return a * (constant<T>(1) / divisor); }
};

template <class T, int rows, int inner, int columns>
Matrix<T, rows, columns> operator*(const Matrix<T, rows, inner>& a, const Matrix<T, inner, columns>& b) {
  Matrix<T, rows, columns> product;
  for (int j = 0; j < columns; ++j) {
    for (int i = 0; i < rows; ++i) {
      product(i, j) = a(i, 0) * b(0, j);
      for (int k = 1; k < inner; ++k) product(i, j) += a(i, k) * b(k, j);
    }
  }
  return product;
}

template <class T>
using Tensor = Matrix<T, 3, 3>;
template <class T>
using Vector = Matrix<T, 3>;

/// Components of a vector in the dimensions of a mesh, and their derivatives with respect to its coordinates.
template <class T, int dim>
using Components = Matrix<T, dim>;
template <class T, int dim>
using Slopes = Matrix<T, dim, dim>;

/// Sum of the products of all entries: a . b of vectors, A : B of tensors.
template <class T, int rows, int columns>
T dot(const Matrix<T, rows, columns>& a, const Matrix<T, rows, columns>& b) {
  T sum = a(0) * b(0);
  for (int i = 1; i < rows * columns; ++i) sum += a(i) * b(i);
  return sum;
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

/// The transposed matrix of the cofactors: the determinant times the inverse.
template <class T>
Tensor<T> adjugate(const Tensor<T>& A) {
  Tensor<T> B;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      B(i, j) = A(a, c) * A(b, d) - A(a, d) * A(b, c);
    }
  }
  return B;
}

template <class T>
Tensor<T> inverse(const Tensor<T>& A) {
  return adjugate(A) / determinant(A);
}

}  // namespace rheocyte
