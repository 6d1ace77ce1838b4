// Products of dense matrices, compiled once. Eigen instantiates its kernels again for each kind of factors in each
// source, which took a third of the time to compile the solver. Here its own rule for products (GemmProduct of
// Eigen 3.4) hands matrices that stand in memory to one function; precompiled with the headers that all sources share.
#pragma once
// A precompiled copy of this header may come from a compiler cache and differ from it in comments; then GCC does not
// see that "#pragma once" means both, but the macro is defined.
#ifndef RHEOCYTE_COMPILED_PRODUCTS
#define RHEOCYTE_COMPILED_PRODUCTS
#include <Eigen/Core>
#include <type_traits>

namespace rheocyte {

/// A matrix in memory: entry (i, j) stands at data[i + stride j], or at data[stride i + j] if it is stored by rows.
template <class Scalar>
struct MatrixInMemory {
  const Scalar* data;
  Eigen::Index rows, columns, stride;
  bool by_rows;
};

/// c += scale a b, where columns of c are `stride` apart; `overwrites`: c = scale a b. For double and float.
template <class Scalar>
void multiply(const MatrixInMemory<Scalar>& a, const MatrixInMemory<Scalar>& b, Scalar scale, bool overwrites,
              Scalar* c, Eigen::Index stride);

template <class Expression>
using BlasTraits = Eigen::internal::blas_traits<Expression>;

template <class Expression>
concept OfNumbers =
    std::is_same_v<typename Expression::Scalar, double> || std::is_same_v<typename Expression::Scalar, float>;

/// Whether the entries of an expression stand in memory one beside the other, but for a common factor.
template <class Expression>
constexpr bool is_in_memory =
    bool(BlasTraits<Expression>::HasUsableDirectAccess) &&
    int(std::remove_cvref_t<typename BlasTraits<Expression>::DirectLinearAccessType>::InnerStrideAtCompileTime) == 1;

template <class Expression>
MatrixInMemory<typename Expression::Scalar> in_memory(const Expression& expression) {
  const auto& matrix = BlasTraits<Expression>::extract(expression);
  return {matrix.data(), matrix.rows(), matrix.cols(), matrix.outerStride(),
          bool(std::remove_cvref_t<decltype(matrix)>::IsRowMajor)};
}

}  // namespace rheocyte

namespace Eigen::internal {

template <rheocyte::OfNumbers Lhs, rheocyte::OfNumbers Rhs>
struct generic_product_impl<Lhs, Rhs, DenseShape, DenseShape, GemmProduct> {
  using Scalar = typename Lhs::Scalar;

  template <class Result>
  static void evalTo(Result& result, const Lhs& a, const Rhs& b) {
    write(result, a, b, 1, true);
  }
  template <class Result>
  static void addTo(Result& result, const Lhs& a, const Rhs& b) {
    write(result, a, b, 1, false);
  }
  template <class Result>
  static void subTo(Result& result, const Lhs& a, const Rhs& b) {
    write(result, a, b, -1, false);
  }
  template <class Result>
  static void scaleAndAddTo(Result& result, const Lhs& a, const Rhs& b, Scalar scale) {
    write(result, a, b, scale, false);
  }

 private:
  template <class Result, class A, class B>
  static void write(Result& result, const A& a, const B& b, Scalar scale, bool overwrites) {
    if constexpr (!rheocyte::is_in_memory<A>) {
      write(result, typename A::PlainObject(a), b, scale, overwrites);
    } else if constexpr (!rheocyte::is_in_memory<B>) {
      write(result, a, typename B::PlainObject(b), scale, overwrites);
    } else if constexpr (Result::IsRowMajor || int(Result::InnerStrideAtCompileTime) != 1) {
      Eigen::Matrix<Scalar, Dynamic, Dynamic> product(a.rows(), b.cols());
      write(product, a, b, scale, true);
      overwrites ? void(result = product) : void(result += product);
    } else {
      scale *= blas_traits<A>::extractScalarFactor(a) * blas_traits<B>::extractScalarFactor(b);
      rheocyte::multiply(rheocyte::in_memory(a), rheocyte::in_memory(b), scale, overwrites, result.data(),
                         result.outerStride());
    }
  }
};

}  // namespace Eigen::internal

#endif
