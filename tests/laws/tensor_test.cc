#include "laws/tensor.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "derivative_error.h"
#include "random_states.h"

namespace rheocyte::tensor_test {
namespace {

using test::RandomStates;
using test::states;

// A dozen operations on numbers of order one; the condition number of the random tensors is below 100.
constexpr double rounding = 1e-13;

TEST(Tensor, TheInverseTimesTheTensorIsTheIdentity) {
  // A^-1 A = A A^-1 = I.
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const Tensor<double> A = random.deformation_gradient(), I = Tensor<double>::Identity();
    EXPECT_LT((inverse(A) * A - I).norm(), rounding);
    EXPECT_LT((A * inverse(A) - I).norm(), rounding);
  }
}

TEST(Tensor, TheDeterminantIsMultiplicative) {
  // det(A B) = det A det B, det A^T = det A, det Q = 1, det(2 A) = 8 det A.
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const Tensor<double> A = random.tensor(1), B = random.tensor(1);
    EXPECT_NEAR(determinant(Tensor<double>(A * B)), determinant(A) * determinant(B), rounding);
    EXPECT_NEAR(determinant(Tensor<double>(A.transpose())), determinant(A), rounding);
    EXPECT_NEAR(determinant(random.rotation()), 1, rounding);
    EXPECT_NEAR(determinant(Tensor<double>(2 * A)), 8 * determinant(A), 10 * rounding);
  }
}

TEST(Tensor, TheyAgreeWithTheLibrarysDeterminantAndInverse) {
  // Eigen computes both in other ways.
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const Tensor<double> A = random.deformation_gradient();
    EXPECT_NEAR(determinant(A), A.eigen().determinant(), rounding);
    EXPECT_LT((inverse(A) - Tensor<double>(A.eigen().inverse())).norm(), rounding);
  }
}

TEST(Tensor, TheDerivativeOfTheDeterminantIsItsCofactor) {
  // d(det A)/dA = det(A) A^-T.
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const Tensor<double> A = random.deformation_gradient();
    const Dual<double, 9> det = determinant(Tensor<Dual<double, 9>>{independent(A.entries)});
    Tensor<double> slope;
    for (int k = 0; k < 9; ++k) slope(k) = det.slope(k);
    EXPECT_LT((slope - determinant(A) * inverse(A).transpose()).norm(), rounding);
  }
}

TEST(Tensor, TheInverseHasTheDerivativeOfCentralDifferences) {
  // d(A^-1)/dA by dual numbers equals central differences.
  RandomStates random;
  const auto law = test::entrywise([](const auto& A) { return inverse(A); });
  for (int i = 0; i < states; ++i) {
    EXPECT_LT(test::derivative_error<9>(law, random.deformation_gradient().entries), test::derivative_tolerance);
  }
}

}  // namespace
}  // namespace rheocyte::tensor_test
