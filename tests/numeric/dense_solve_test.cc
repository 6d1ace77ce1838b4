// Dense systems against what they must satisfy.
#include "numeric/dense_solve.h"

#include <gtest/gtest.h>

namespace rheocyte::dense_solve_test {
namespace {

constexpr double rounding = 1e-12;

Eigen::MatrixXd positive_definite(int size) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(size, size);
  return A * A.transpose() + Eigen::MatrixXd::Identity(size, size);
}

TEST(DenseSolve, TheSolutionSatisfiesTheSystem) {
  for (const int size : {1, 7, 40}) {
    const Eigen::MatrixXd A = positive_definite(size), b = Eigen::MatrixXd::Random(size, 3);
    EXPECT_LT((A * solve_dense(A, b) - b).norm(), rounding) << size;
  }
}

TEST(DenseSolve, ASingularSystemHasNoFiniteSolution) {
  EXPECT_FALSE(solve_dense(Eigen::MatrixXd::Zero(3, 3), Eigen::VectorXd::Ones(3)).allFinite());
}

TEST(DenseSolve, AMatrixThatIsSingularToRoundingHasNoRegularInverse) {
  const Eigen::MatrixXd A = positive_definite(4), B = Eigen::MatrixXd::Random(4, 3);
  EXPECT_LT((A * regular_inverse(A) - Eigen::MatrixXd::Identity(4, 4)).norm(), rounding);
  EXPECT_EQ(regular_inverse(B * B.transpose()).size(), 0);
}

TEST(DenseSolve, ANullVectorIsMappedToNothing) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(4, 5);
  const Eigen::VectorXd x = null_vector(A);
  EXPECT_GT(x.norm(), 0);
  EXPECT_LT((A * x).norm(), rounding * x.norm());
}

TEST(DenseSolve, TheResidualOfLeastSquaresIsOrthogonalToTheColumns) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(20, 4);
  const Eigen::VectorXd b = Eigen::VectorXd::Random(20);
  EXPECT_LT((A.transpose() * (A * least_squares(A, b) - b)).norm(), rounding);
}

TEST(DenseSolve, WhiteNumbersHaveTheUnitCovariance) {
  // W C W^T = I with a lower triangular W; a covariance that is none has no W.
  const Eigen::MatrixXd C = positive_definite(6), W = whitening(C);
  EXPECT_LT((W * C * W.transpose() - Eigen::MatrixXd::Identity(6, 6)).norm(), rounding);
  EXPECT_EQ(Eigen::MatrixXd(W.triangularView<Eigen::StrictlyUpper>()).norm(), 0);
  EXPECT_EQ(whitening(-C).size(), 0);
}

}  // namespace
}  // namespace rheocyte::dense_solve_test
