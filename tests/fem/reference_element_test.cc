#include "fem/reference_element.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rheocyte::reference_element_test {
namespace {

// Sums of up to 1,000 terms of order one.
constexpr double rounding = 1e-12;

/// Elements of each dimension and several degrees.
template <class Check>
void for_each_element(const Check& check) {
  for (const int degree : {1, 2, 4, 6, 8, 10}) check(ReferenceElement<2>(degree));
  for (const int degree : {1, 2, 4, 5}) check(ReferenceElement<3>(degree));
}

/// A function of the coordinates at the points of a tensor grid, the first coordinate fastest.
template <int dim, class Function>
VectorXd on_grid(const VectorXd& x, const Function& function) {
  const int n = int(x.size());
  VectorXd values(int(std::pow(n, dim) + 0.5));
  for (int i = 0; i < values.size(); ++i) {
    typename ReferenceElement<dim>::Coordinates xi;
    for (int k = 0, rest = i; k < dim; ++k, rest /= n) xi(k) = x(rest % n);
    values(i) = function(xi);
  }
  return values;
}

/// prod_k xi_k^p - 2 xi_1 xi_last^(p-1), and its derivative with respect to a coordinate.
template <int dim>
struct Polynomial {
  using Coordinates = typename ReferenceElement<dim>::Coordinates;
  int p;
  double operator()(const Coordinates& x) const {
    return std::pow(x.prod(), p) - 2 * x(0) * std::pow(x(dim - 1), p - 1);
  }
  double slope(const Coordinates& x, int k) const {
    double value = p * std::pow(x.prod(), p - 1) * x.prod() / x(k);
    if (k == 0) value -= 2 * std::pow(x(dim - 1), p - 1);
    if (k == dim - 1 && p > 1) value -= 2 * x(0) * (p - 1) * std::pow(x(dim - 1), p - 2);
    return value;
  }
};

TEST(ReferenceElement, TheShapeFunctionsAddUpToOne) {
  // sum_k N_k = 1 and sum_k dN_k = 0 at every quadrature point.
  for_each_element([](const auto& element) {
    EXPECT_LT((element.shape.value.rowwise().sum().array() - 1).abs().maxCoeff(), rounding);
    for (const MatrixXd& slope : element.shape.slope)
      EXPECT_LT(slope.rowwise().sum().cwiseAbs().maxCoeff(), 10 * rounding);  // slopes up to p^2
  });
}

TEST(ReferenceElement, APolynomialOfTheSpaceComesBackToRounding) {
  // Values of a Q_p polynomial at the quadrature points and at any point follow from those at the nodes.
  for_each_element([]<int dim>(const ReferenceElement<dim>& element) {
    const Polynomial<dim> exact{element.degree()};
    const VectorXd nodal = on_grid<dim>(element.nodes_1d, exact);
    EXPECT_LT((element.shape.value * nodal - on_grid<dim>(element.points_1d, exact)).cwiseAbs().maxCoeff(), rounding);
    typename ReferenceElement<dim>::Coordinates x;
    for (int k = 0; k < dim; ++k) x(k) = 0.31 + 0.26 * k;
    EXPECT_NEAR(element.interpolate(nodal, x), exact(x), rounding);
  });
}

TEST(ReferenceElement, ItsDerivativesAreThoseOfThePolynomial) {
  // With respect to every coordinate, at every quadrature point.
  for_each_element([]<int dim>(const ReferenceElement<dim>& element) {
    const Polynomial<dim> exact{element.degree()};
    const VectorXd nodal = on_grid<dim>(element.nodes_1d, exact);
    for (int k = 0; k < dim; ++k) {
      const VectorXd slope = on_grid<dim>(element.points_1d, [&](const auto& x) { return exact.slope(x, k); });
      const double error = (element.shape.slope[k] * nodal - slope).cwiseAbs().maxCoeff();
      EXPECT_LT(error, 100 * rounding);  // slopes up to p^2 of values up to 2
    }
  });
}

TEST(ReferenceElement, TheStackHoldsValuesAndDerivativesBelowEachOther) {
  // Rows of the stack: value, then the slopes.
  for_each_element([]<int dim>(const ReferenceElement<dim>& element) {
    const int n = element.points();
    EXPECT_EQ(element.shape_stack.rows(), (1 + dim) * n);
    for (int k = 0; k <= dim; ++k) EXPECT_EQ(element.shape_stack.middleRows(k * n, n), element.shape.part(k));
  });
}

TEST(ReferenceElement, ThePressureModesAreOrthonormalAndTheFirstIsOne) {
  // int psi_i psi_j = delta_ij; as many as polynomials of total degree below p.
  for_each_element([]<int dim>(const ReferenceElement<dim>& element) {
    const int p = element.degree();
    const MatrixXd mass = element.pressure.value.transpose() * element.weights.asDiagonal() * element.pressure.value;
    EXPECT_EQ(mass.rows(), dim == 2 ? p * (p + 1) / 2 : p * (p + 1) * (p + 2) / 6);
    EXPECT_LT((mass - MatrixXd::Identity(mass.rows(), mass.cols())).cwiseAbs().maxCoeff(), rounding);
    EXPECT_LT((element.pressure.value.col(0).array() - 1).abs().maxCoeff(), rounding);
  });
}

TEST(ReferenceElement, TheQuadratureIntegratesPolynomialsExactly) {
  // p + 2 Gauss points per direction: degree 2 p + 3.
  for_each_element([]<int dim>(const ReferenceElement<dim>& element) {
    const int degree = 2 * element.degree() + 3;
    const VectorXd values = on_grid<dim>(element.points_1d, [&](const auto& x) { return std::pow(x.prod(), degree); });
    EXPECT_NEAR(element.weights.dot(values) * std::pow(degree + 1, dim), 1, rounding);
  });
}

TEST(ReferenceElement, TheInteriorNodesAreThoseOffTheFaces) {
  // (p - 1)^dim of (p + 1)^dim.
  for_each_element([]<int dim>(const ReferenceElement<dim>& element) {
    const int p = element.degree();
    int interior = 0;
    for (int k = 0; k < element.nodes(); ++k) interior += element.is_interior(k);
    EXPECT_EQ(interior, int(std::pow(p - 1, dim) + 0.5));
    EXPECT_EQ(element.nodes(), int(std::pow(p + 1, dim) + 0.5));
  });
}

}  // namespace
}  // namespace rheocyte::reference_element_test
