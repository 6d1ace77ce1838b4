#include "shape/curve.h"

#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace rheocyte {
namespace {

struct LegendreValues {
  double value, previous;  // P_n and P_{n-1}
};

LegendreValues legendre(int n, double x) {
  double previous = 1, value = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
    previous = value;
    value = next;
  }
  return n == 0 ? LegendreValues{1, 0} : LegendreValues{value, previous};
}

// Newton's method from the Chebyshev points converges in fewer than ten steps for every n in use.
constexpr int newton_steps = 20;

struct LobattoBasis {
  Eigen::VectorXd nodes, weights;  // barycentric weights
  Eigen::MatrixXd differentiation;
};

Eigen::VectorXd compute_lobatto_nodes(int degree) {
  Eigen::VectorXd nodes(degree + 1);
  for (int i = 0; i <= degree; ++i) {
    double x = -std::cos(std::numbers::pi * i / degree);
    for (int step = 0; step < newton_steps; ++step) {
      const auto [value, previous] = legendre(degree, x);
      x -= (x * value - previous) / ((degree + 1) * value);
    }
    nodes(i) = 0.5 * (1 + x);
  }
  nodes(0) = 0;
  nodes(degree) = 1;
  return nodes;
}

LobattoBasis compute_lobatto_basis(int degree) {
  LobattoBasis basis;
  const Eigen::VectorXd& t = basis.nodes = compute_lobatto_nodes(degree);
  const int n = degree + 1;
  basis.weights = Eigen::VectorXd::Ones(n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (j != i) basis.weights(i) /= t(i) - t(j);
  basis.differentiation = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j)
      if (j != i) basis.differentiation(i, j) = basis.weights(j) / (basis.weights(i) * (t(i) - t(j)));
    // The derivative of a constant is zero to rounding only if the diagonal is the negative sum of the rest.
    basis.differentiation(i, i) = -basis.differentiation.row(i).sum();
  }
  return basis;
}

const LobattoBasis& lobatto_basis(int degree) {
  assert(degree >= 1 && degree <= max_curve_degree);
  static const auto all = [] {
    std::array<LobattoBasis, max_curve_degree + 1> bases;
    for (int p = 1; p <= max_curve_degree; ++p) bases[p] = compute_lobatto_basis(p);
    return bases;
  }();
  return all[degree];
}

using BasisRow = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, max_curve_degree + 1>;

BasisRow basis_row(const LobattoBasis& basis, double t) {
  BasisRow row(basis.nodes.size());
  for (Eigen::Index j = 0; j < row.size(); ++j) {
    const double distance = t - basis.nodes(j);
    if (distance == 0) {
      row.setZero();
      row(j) = 1;
      return row;
    }
    row(j) = basis.weights(j) / distance;
  }
  return row / row.sum();
}

}  // namespace

const Eigen::VectorXd& lobatto_nodes(int degree) { return lobatto_basis(degree).nodes; }

Eigen::MatrixXd lagrange_basis(int degree, const Eigen::VectorXd& parameters) {
  const LobattoBasis& basis = lobatto_basis(degree);
  Eigen::MatrixXd values(parameters.size(), degree + 1);
  for (Eigen::Index k = 0; k < parameters.size(); ++k) values.row(k) = basis_row(basis, parameters(k));
  return values;
}

Eigen::MatrixXd lagrange_slopes(int degree, const Eigen::VectorXd& parameters) {
  return lagrange_basis(degree, parameters) * lobatto_basis(degree).differentiation;
}

Eigen::MatrixX2d evaluate(const CurvePiece& piece, const Eigen::VectorXd& parameters) {
  return lagrange_basis(degree_of(piece), parameters) * piece;
}

Eigen::Vector2d evaluate(const CurvePiece& piece, double parameter) {
  const BasisRow row = basis_row(lobatto_basis(degree_of(piece)), parameter);
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  for (Eigen::Index j = 0; j < row.size(); ++j) point += row(j) * piece.row(j).transpose();
  return point;
}

CurvePiece derivative(const CurvePiece& piece) { return lobatto_basis(degree_of(piece)).differentiation * piece; }

Quadrature gauss_legendre(int n) {
  assert(n >= 1);
  Quadrature rule{Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    double slope = 1;
    for (int step = 0; step < newton_steps; ++step) {
      const auto [value, previous] = legendre(n, x);
      slope = n * (x * value - previous) / (x * x - 1);
      x -= value / slope;
    }
    rule.points(i) = 0.5 * (1 + x);
    rule.weights(i) = 1 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

}  // namespace rheocyte
