#include "shape/curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rheocyte::curve_test {
namespace {

// Sums of at most 13 terms of order one; differentiation multiplies rounding by about degree^2.
constexpr double rounding = 1e-13, differentiated_rounding = 1e-11;

Eigen::VectorXd dense() { return Eigen::VectorXd::LinSpaced(37, 0, 1); }

TEST(Curve, NodesAreThoseOfTheGaussLobattoRule) {
  // The nodes of degree 2, 3 and 4 are known: 1/2; (1 -+ 1/sqrt 5)/2; 1/2 and (1 -+ sqrt(3/7))/2.
  EXPECT_NEAR(lobatto_nodes(2)(1), 0.5, rounding);
  EXPECT_NEAR(lobatto_nodes(3)(1), 0.5 * (1 - 1 / std::sqrt(5.0)), rounding);
  EXPECT_NEAR(lobatto_nodes(4)(1), 0.5 * (1 - std::sqrt(3.0 / 7)), rounding);
  EXPECT_NEAR(lobatto_nodes(4)(2), 0.5, rounding);
}

TEST(Curve, AnEllipsePieceConvergesExponentiallyInTheDegree) {
  // Each degree more gains at least a factor 4 for a quarter of a circle, until rounding is reached.
  double previous = 1;
  for (int degree = 1; degree <= max_curve_degree; ++degree) {
    const Eigen::ArrayXd angle = 0.5 * std::numbers::pi * lobatto_nodes(degree).array();
    CurvePiece piece(degree + 1, 2);
    piece << angle.cos(), angle.sin();
    const Eigen::ArrayXd wanted = 0.5 * std::numbers::pi * dense().array();
    const double error = (evaluate(piece, dense()).col(0).array() - wanted.cos()).abs().maxCoeff();
    EXPECT_LT(error, std::max(previous / 4, rounding)) << "degree " << degree;
    previous = error;
  }
}

TEST(Curve, APolynomialOfTheDegreeComesBackWithItsDerivatives) {
  // t^p and its first two derivatives are reproduced at any parameter.
  for (int p = 2; p <= max_curve_degree; ++p) {
    CurvePiece piece(p + 1, 2);
    piece << lobatto_nodes(p).array().pow(p), lobatto_nodes(p);
    const Eigen::ArrayXd t = dense().array();
    const CurvePiece slope = derivative(piece);
    EXPECT_LT((evaluate(piece, dense()).col(0).array() - t.pow(p)).abs().maxCoeff(), rounding);
    EXPECT_LT((evaluate(slope, dense()).col(0).array() - p * t.pow(p - 1)).abs().maxCoeff(), differentiated_rounding);
    EXPECT_LT((evaluate(derivative(slope), dense()).col(0).array() - p * (p - 1) * t.pow(p - 2)).abs().maxCoeff(),
              p * p * differentiated_rounding);
    EXPECT_LT((evaluate(slope, dense()).col(1).array() - 1).abs().maxCoeff(), differentiated_rounding);
  }
}

TEST(Curve, OneParameterAndManyGiveTheSamePoint) {
  // The evaluation at a single parameter is the same polynomial as the evaluation in bulk.
  const CurvePiece piece = CurvePiece::Random(7, 2);
  const Eigen::MatrixX2d points = evaluate(piece, dense());
  for (Eigen::Index k = 0; k < points.rows(); ++k)
    EXPECT_LT((evaluate(piece, dense()(k)) - points.row(k).transpose()).norm(), rounding);
}

TEST(Curve, GaussQuadratureIsExactForDegreeTwoNMinusOne) {
  // int_0^1 t^k dt = 1/(k+1) for every k up to 2n - 1.
  for (int n : {1, 2, 5, 16, 40}) {
    const Quadrature rule = gauss_legendre(n);
    for (int k = 0; k < 2 * n; ++k)
      EXPECT_NEAR(rule.weights.dot(rule.points.array().pow(k).matrix()), 1.0 / (k + 1), rounding) << n << " " << k;
  }
}

}  // namespace
}  // namespace rheocyte::curve_test
