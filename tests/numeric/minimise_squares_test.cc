// Least squares whose minima are known.
#include "numeric/minimise_squares.h"

#include <gtest/gtest.h>

#include <cmath>

#include "numeric/dense_solve.h"

namespace rheocyte::minimise_squares_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(MinimiseSquares, OfLinearResidualsIsTheSolutionOfTheNormalEquations) {
  const MatrixXd A = MatrixXd::Random(9, 3);
  const VectorXd b = VectorXd::Random(9), exact = least_squares(A, b);
  VectorXd x = VectorXd::Constant(3, 5);
  const double squares = minimise_squares(
      [&](const VectorXd& at, MatrixXd* slopes) -> VectorXd {
        if (slopes) *slopes = A;
        return A * at - b;
      },
      x);
  // The last step gains less than 1e-9, which is the square of how far off x is.
  EXPECT_LT((x - exact).norm(), 1e-4);
  EXPECT_NEAR(squares, (A * exact - b).squaredNorm(), 1e-9);
}

/// Rosenbrock's valley, from beyond the bend.
VectorXd valley(const VectorXd& x, MatrixXd* slopes) {
  if (slopes) {
    slopes->resize(2, 2);
    *slopes << -20 * x(0), 10, -1, 0;
  }
  return Eigen::Vector2d(10 * (x(1) - x(0) * x(0)), 1 - x(0));
}

TEST(MinimiseSquares, FollowsABentValley) {
  VectorXd x = Eigen::Vector2d(-1.2, 1);
  EXPECT_LT(minimise_squares(valley, x), 1e-9);
  EXPECT_LT((x - Eigen::Vector2d(1, 1)).norm(), 1e-4);  // the root of the gain that is left
}

TEST(MinimiseSquares, WhereResidualsAreNotFiniteTheStartIsKept) {
  VectorXd x = Eigen::Vector2d(3, 4);
  const double squares = minimise_squares(
      [](const VectorXd& at, MatrixXd* slopes) -> VectorXd {
        if (slopes) *slopes = MatrixXd::Identity(2, 2);
        return VectorXd::Constant(at.size(), NAN);
      },
      x);
  EXPECT_TRUE(std::isnan(squares));
  EXPECT_EQ(x, Eigen::Vector2d(3, 4));
}

}  // namespace
}  // namespace rheocyte::minimise_squares_test
