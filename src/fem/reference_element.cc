#include "fem/reference_element.h"

#include <cmath>

#include "shape/curve.h"

namespace rheocyte {
namespace {

/// Tensor product with the first coordinate fastest: rows (q1, q2), columns (i1, i2).
MatrixXd tensor(const MatrixXd& first, const MatrixXd& second) {
  MatrixXd product(first.rows() * second.rows(), first.cols() * second.cols());
  for (int j = 0; j < second.cols(); ++j) {
    for (int q = 0; q < second.rows(); ++q) {
      product.block(q * first.rows(), j * first.cols(), first.rows(), first.cols()) = second(q, j) * first;
    }
  }
  return product;
}

/// Legendre polynomials of degree < count, orthonormal on [0, 1].
VectorXd orthonormal_legendre(int count, double x) {
  VectorXd values(count);
  for (int k = 0; k < count; ++k) values(k) = std::sqrt(2.0 * k + 1) * std::legendre(unsigned(k), 2 * x - 1);
  return values;
}

}  // namespace

ReferenceElement::ReferenceElement(int degree) : degree_(degree) {
  nodes_1d = lobatto_nodes(degree);
  const Quadrature gauss = gauss_legendre(degree + 2);
  points_1d = gauss.points;
  weights_1d = gauss.weights;
  weights = tensor(weights_1d, weights_1d);

  const MatrixXd value = lagrange(points_1d), slope = lagrange_derivative(points_1d);
  shape = {tensor(value, value), tensor(slope, value), tensor(value, slope)};
  shape_stack.resize(3 * points(), nodes());
  shape_stack << shape.value, shape.d1, shape.d2;
  const int n = int(points_1d.size());
  pressure.value.resize(n * n, pressures());
  for (int q = 0; q < n * n; ++q) pressure.value.row(q) = pressure_modes(points_1d(q % n), points_1d(q / n));
}

bool ReferenceElement::is_interior(int node) const {
  const int i = node % (degree_ + 1), j = node / (degree_ + 1);
  return i > 0 && i < degree_ && j > 0 && j < degree_;
}

MatrixXd ReferenceElement::lagrange(const VectorXd& at) const { return lagrange_basis(degree_, at); }
MatrixXd ReferenceElement::lagrange_derivative(const VectorXd& at) const { return lagrange_slopes(degree_, at); }

double ReferenceElement::interpolate(const VectorXd& nodal, double xi1, double xi2) const {
  const Eigen::Map<const MatrixXd> grid(nodal.data(), degree_ + 1, degree_ + 1);
  const MatrixXd basis = lagrange(Eigen::Vector2d(xi1, xi2));
  return basis.row(0) * grid * basis.row(1).transpose();
}

VectorXd ReferenceElement::pressure_modes(double xi1, double xi2) const {
  const VectorXd first = orthonormal_legendre(degree_, xi1), second = orthonormal_legendre(degree_, xi2);
  VectorXd modes(pressures());
  int k = 0;
  for (int total = 0; total < degree_; ++total) {
    for (int j = 0; j <= total; ++j) modes(k++) = first(total - j) * second(j);
  }
  return modes;
}

}  // namespace rheocyte
