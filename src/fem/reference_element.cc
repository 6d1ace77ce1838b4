#include "fem/reference_element.h"

#include <cmath>

#include "numeric/dense_solve.h"
#include "numeric/special_functions.h"
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

/// Tensor product of `other` in direction `direction` and `common` in the other ones.
template <int dim>
MatrixXd tensor(const MatrixXd& common, const MatrixXd& other, int direction) {
  MatrixXd product = direction == 0 ? other : common;
  for (int k = 1; k < dim; ++k) product = tensor(product, k == direction ? other : common);
  return product;
}

/// Products of two functions at each point, the first function fastest.
MatrixXd products_of(const MatrixXd& first, const MatrixXd& second) {
  MatrixXd products(first.rows(), first.cols() * second.cols());
  for (int j = 0; j < second.cols(); ++j)
    products.middleCols(j * first.cols(), first.cols()) = second.col(j).asDiagonal() * first;
  return products;
}

/// Legendre polynomials of degree < count, orthonormal on [0, 1].
VectorXd orthonormal_legendre(int count, double x) {
  VectorXd values(count);
  for (int k = 0; k < count; ++k) values(k) = std::sqrt(2.0 * k + 1) * legendre(k, 2 * x - 1);
  return values;
}

/// Appends the products of polynomials (rows: directions) of total degree `total`, the degree in the last of the first
/// `directions` ones rising slowest.
void append_products(const MatrixXd& polynomials, int directions, int total, double factor, VectorXd& modes, int& k) {
  if (directions == 1) {
    modes(k++) = factor * polynomials(0, total);
    return;
  }
  for (int j = 0; j <= total; ++j)
    append_products(polynomials, directions - 1, total - j, factor * polynomials(directions - 1, j), modes, k);
}

}  // namespace

template <int dim>
ReferenceElement<dim>::ReferenceElement(int degree, int number_1d) : degree_(degree) {
  nodes_1d = lobatto_nodes(degree);
  const Quadrature gauss = gauss_legendre(number_1d);
  points_1d = gauss.points;
  weights_1d = gauss.weights;
  weights = tensor<dim>(weights_1d, weights_1d, 0);

  const MatrixXd value = lagrange(points_1d), slope = lagrange_derivative(points_1d);
  shape.value = tensor<dim>(value, value, 0);
  for (int k = 0; k < dim; ++k) shape.slope[k] = tensor<dim>(value, slope, k);
  shape_stack.resize((1 + dim) * points(), nodes());
  for (int k = 0; k <= dim; ++k) shape_stack.middleRows(k * points(), points()) = shape.part(k);
  MatrixXd modes_1d(points_1d.size(), degree);
  for (int q = 0; q < points_1d.size(); ++q) modes_1d.row(q) = orthonormal_legendre(degree, points_1d(q));
  products_1d.resize(4 * points_1d.size(), nodes_1d.size() * nodes_1d.size());
  products_1d << products_of(value, value), products_of(slope, value), products_of(value, slope),
      products_of(slope, slope);
  mode_products_1d.resize(2 * points_1d.size(), nodes_1d.size() * degree);
  mode_products_1d << products_of(value, modes_1d), products_of(slope, modes_1d);
  const int n = int(points_1d.size());
  for (int q = 0; q < points(); ++q) {
    Coordinates xi;
    for (int k = 0, rest = q; k < dim; ++k, rest /= n) xi(k) = points_1d(rest % n);
    const VectorXd modes = pressure_modes(xi);
    if (q == 0) pressure.value.resize(points(), modes.size());
    pressure.value.row(q) = modes;
  }
}

template <int dim>
bool ReferenceElement<dim>::is_interior(int node) const {
  for (int k = 0; k < dim; ++k, node /= degree_ + 1) {
    const int i = node % (degree_ + 1);
    if (i == 0 || i == degree_) return false;
  }
  return true;
}

template <int dim>
MatrixXd ReferenceElement<dim>::lagrange(const VectorXd& at) const {
  return lagrange_basis(degree_, at);
}

template <int dim>
MatrixXd ReferenceElement<dim>::lagrange_derivative(const VectorXd& at) const {
  return lagrange_slopes(degree_, at);
}

template <int dim>
MatrixXd ReferenceElement<dim>::points_to_nodes() const {
  const MatrixXd at_points = lagrange(points_1d), tested = at_points.transpose() * weights_1d.asDiagonal();
  return solve_dense(tested * at_points, tested);
}

template <int dim>
double ReferenceElement<dim>::interpolate(const VectorXd& nodal, const Coordinates& xi) const {
  const MatrixXd basis = lagrange(xi);
  MatrixXd values = basis.row(0);
  for (int k = 1; k < dim; ++k) values = tensor(values, basis.row(k));
  return values.row(0).dot(nodal);
}

template <int dim>
VectorXd ReferenceElement<dim>::pressure_modes(const Coordinates& xi) const {
  MatrixXd polynomials(dim, degree_);
  int count = 1;  // (p + dim - 1)! / ((p - 1)! dim!)
  for (int k = 0; k < dim; ++k) {
    polynomials.row(k) = orthonormal_legendre(degree_, xi(k));
    count = count * (degree_ + k) / (k + 1);
  }
  VectorXd modes(count);
  int k = 0;
  for (int total = 0; total < degree_; ++total) append_products(polynomials, dim, total, 1, modes, k);
  return modes;
}

template class ReferenceElement<2>;
template class ReferenceElement<3>;

}  // namespace rheocyte
