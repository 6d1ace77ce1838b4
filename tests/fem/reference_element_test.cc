#include "fem/reference_element.h"

#include <gtest/gtest.h>

namespace rheocyte {
namespace {

constexpr std::array degrees = {1, 2, 4, 6, 8, 10};
// Sums of up to 121 terms of order one.
constexpr double rounding = 1e-12;

TEST(ReferenceElement, TheShapeFunctionsAddUpToOne) {
  // sum_k N_k = 1 and sum_k dN_k = 0 at every quadrature point.
  for (const int degree : degrees) {
    const ReferenceElement element(degree);
    EXPECT_LT((element.shape.value.rowwise().sum().array() - 1).abs().maxCoeff(), rounding);
    EXPECT_LT(element.shape.d1.rowwise().sum().cwiseAbs().maxCoeff(), 10 * rounding);  // slopes up to p^2
    EXPECT_LT(element.shape.d2.rowwise().sum().cwiseAbs().maxCoeff(), 10 * rounding);
  }
}

/// x^p y^p - 2 x y^(p-1) at the nodes or points of the tensor grid of 1D coordinates.
VectorXd polynomial(const VectorXd& x, int p) {
  const int n = int(x.size());
  VectorXd values(n * n);
  for (int k = 0; k < n * n; ++k) {
    values(k) = std::pow(x(k % n) * x(k / n), p) - 2 * x(k % n) * std::pow(x(k / n), p - 1);
  }
  return values;
}

TEST(ReferenceElement, APolynomialOfTheSpaceComesBackToRounding) {
  // Values of a Q_p polynomial at the quadrature points and at any point follow from those at the nodes.
  for (const int p : degrees) {
    const ReferenceElement element(p);
    const VectorXd nodal = polynomial(element.nodes_1d, p);
    EXPECT_LT((element.shape.value * nodal - polynomial(element.points_1d, p)).cwiseAbs().maxCoeff(), rounding);
    const double x = 0.31, y = 0.83;
    const double exact = std::pow(x * y, p) - 2 * x * std::pow(y, p - 1);
    EXPECT_NEAR(element.interpolate(nodal, x, y), exact, rounding);
  }
}

TEST(ReferenceElement, ItsDerivativesAreThoseOfThePolynomial) {
  // d/d(xi1) and d/d(xi2) of xi1^p xi2 are exact.
  for (const int p : degrees) {
    const ReferenceElement element(p);
    const int n = int(element.nodes_1d.size()), m = int(element.points_1d.size());
    VectorXd nodal(n * n);
    for (int k = 0; k < n * n; ++k) nodal(k) = std::pow(element.nodes_1d(k % n), p) * element.nodes_1d(k / n);
    const VectorXd d1 = element.shape.d1 * nodal, d2 = element.shape.d2 * nodal;
    for (int q = 0; q < m * m; ++q) {
      const double x = element.points_1d(q % m), y = element.points_1d(q / m);
      EXPECT_NEAR(d1(q), p * std::pow(x, p - 1) * y, 10 * rounding);  // slopes up to p^2
      EXPECT_NEAR(d2(q), std::pow(x, p), 10 * rounding);
    }
  }
}

TEST(ReferenceElement, TheStackHoldsValuesAndDerivativesBelowEachOther) {
  // Rows of the stack: value, d1, d2.
  const ReferenceElement element(3);
  const int n = element.points();
  EXPECT_EQ(element.shape_stack.topRows(n), element.shape.value);
  EXPECT_EQ(element.shape_stack.middleRows(n, n), element.shape.d1);
  EXPECT_EQ(element.shape_stack.bottomRows(n), element.shape.d2);
}

TEST(ReferenceElement, ThePressureModesAreOrthonormalAndTheFirstIsOne) {
  // int psi_i psi_j = delta_ij.
  for (const int p : degrees) {
    const ReferenceElement element(p);
    const MatrixXd mass = element.pressure.value.transpose() * element.weights.asDiagonal() * element.pressure.value;
    EXPECT_EQ(mass.rows(), p * (p + 1) / 2);
    EXPECT_LT((mass - MatrixXd::Identity(mass.rows(), mass.cols())).cwiseAbs().maxCoeff(), rounding);
    EXPECT_LT((element.pressure.value.col(0).array() - 1).abs().maxCoeff(), rounding);
    EXPECT_LT((element.pressure_modes(0.2, 0.9) - element.pressure_modes(0.2, 0.9)).norm(), rounding);
  }
}

TEST(ReferenceElement, TheQuadratureIntegratesPolynomialsExactly) {
  // p + 2 Gauss points per direction: degree 2 p + 3.
  for (const int p : degrees) {
    const ReferenceElement element(p);
    const int m = int(element.points_1d.size()), degree = 2 * p + 3;
    double sum = 0;
    for (int q = 0; q < m * m; ++q) {
      sum += element.weights(q) * std::pow(element.points_1d(q % m) * element.points_1d(q / m), degree);
    }
    EXPECT_NEAR(sum * (degree + 1) * (degree + 1), 1, rounding);
  }
}

TEST(ReferenceElement, TheInteriorNodesAreThoseOffTheEdges) {
  // (p - 1)^2 of (p + 1)^2.
  for (const int p : degrees) {
    const ReferenceElement element(p);
    int interior = 0;
    for (int k = 0; k < element.nodes(); ++k) interior += element.is_interior(k);
    EXPECT_EQ(interior, (p - 1) * (p - 1));
  }
}

}  // namespace
}  // namespace rheocyte
