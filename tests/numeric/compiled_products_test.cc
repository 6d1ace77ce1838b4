// Products by the rule of compiled_products.h are those of Eigen's sums coefficient by coefficient.
#include "numeric/compiled_products.h"

#include <gtest/gtest.h>

#include <limits>

namespace rheocyte::compiled_products_test {
namespace {

/// Of sums of up to 40 products of numbers below 1.
template <class Scalar>
constexpr Scalar rounding = 200 * std::numeric_limits<Scalar>::epsilon();

/// Sizes on both sides of what Eigen takes for small, vectors and empty matrices among them.
constexpr int sizes[] = {0, 1, 2, 5, 9, 40};

template <class Scalar, int order_a, int order_b, int order_c>
void expect_products() {
  using A = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, order_a>;
  using B = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, order_b>;
  using C = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, order_c>;
  for (const int rows : sizes) {
    for (const int inner : sizes) {
      for (const int columns : sizes) {
        const A a = A::Random(rows, inner);
        const B b = B::Random(inner, columns);
        const C before = C::Random(rows, columns), product = a.lazyProduct(b);
        const auto expect = [&](const C& found, const C& expected) {
          EXPECT_TRUE(found.size() == 0 || (found - expected).cwiseAbs().maxCoeff() <= rounding<Scalar>)
              << rows << " x " << inner << " x " << columns;
        };
        C c = before;
        c.noalias() = a * b;
        expect(c, product);
        c = before;
        c.noalias() += a * b;
        expect(c, before + product);
        c = before;
        c.noalias() -= Scalar(2) * a * b;
        expect(c, before - Scalar(2) * product);
      }
    }
  }
}

template <class Scalar>
void expect_products_of_all_orders() {
  constexpr int columns = Eigen::ColMajor, rows = Eigen::RowMajor;
  expect_products<Scalar, columns, columns, columns>();
  expect_products<Scalar, rows, columns, columns>();
  expect_products<Scalar, columns, rows, columns>();
  expect_products<Scalar, rows, rows, columns>();
  expect_products<Scalar, columns, columns, rows>();
}

TEST(CompiledProducts, AreTheSumsOfProductsInDoublePrecision) { expect_products_of_all_orders<double>(); }

TEST(CompiledProducts, AreTheSumsOfProductsInSinglePrecision) { expect_products_of_all_orders<float>(); }

TEST(CompiledProducts, PartsOfMatricesAndExpressionsAreFactorsToo) {
  // Blocks have strides; sums stand nowhere in memory; a result may be a block, or transposed.
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(30, 30), b = Eigen::MatrixXd::Random(30, 30);
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(30, 30);
  c.block(2, 3, 20, 15).noalias() = a.block(1, 4, 20, 12).transpose().transpose() * b.block(5, 6, 12, 15);
  c.block(2, 18, 15, 12).transpose().noalias() = (a + b).topLeftCorner(12, 20) * b.topLeftCorner(20, 15);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(30, 30);
  expected.block(2, 3, 20, 15) = a.block(1, 4, 20, 12).lazyProduct(b.block(5, 6, 12, 15));
  const Eigen::MatrixXd sum = a + b;
  expected.block(2, 18, 15, 12) = sum.topLeftCorner(12, 20).lazyProduct(b.topLeftCorner(20, 15)).eval().transpose();
  EXPECT_LT((c - expected).cwiseAbs().maxCoeff(), rounding<double>);
}

TEST(CompiledProducts, AFactorMayBeWrittenTo) {
  // Eigen evaluates the product first, unless the code states that nothing is shared.
  Eigen::MatrixXd a = Eigen::MatrixXd::Random(25, 25);
  const Eigen::MatrixXd b = a, expected = b.lazyProduct(b);
  a = a * a;
  EXPECT_LT((a - expected).cwiseAbs().maxCoeff(), rounding<double>);
}

}  // namespace
}  // namespace rheocyte::compiled_products_test
