// Polynomial curve pieces: Gauss-Lobatto nodes, Lagrange evaluation in barycentric form, Gauss quadrature.
#pragma once
#include <Eigen/Core>

#include "shape/contour.h"

namespace rheocyte {

inline constexpr int max_curve_degree = 12;

/// Degree of a piece: rows - 1. Every function below expects 1 <= degree <= max_curve_degree (asserted).
inline int degree_of(const CurvePiece& piece) { return static_cast<int>(piece.rows()) - 1; }

/// The degree + 1 Gauss-Legendre-Lobatto points of [0, 1], ascending; the first is 0, the last 1.
const Eigen::VectorXd& lobatto_nodes(int degree);

/// Values of the degree + 1 Lagrange polynomials of the Lobatto nodes: row k belongs to parameters(k).
Eigen::MatrixXd lagrange_basis(int degree, const Eigen::VectorXd& parameters);

/// Their derivatives, in the same layout.
Eigen::MatrixXd lagrange_slopes(int degree, const Eigen::VectorXd& parameters);

/// Points (x, r) of the piece, one row per parameter in [0, 1]; unit of the contour.
Eigen::MatrixX2d evaluate(const CurvePiece& piece, const Eigen::VectorXd& parameters);

/// The point (x, r) at one parameter in [0, 1].
Eigen::Vector2d evaluate(const CurvePiece& piece, double parameter);

/// d(x, r)/dt as a piece on the same nodes; exact, because the derivative lies in the same polynomial space.
/// evaluate(derivative(piece), t) is the tangent at t, applied twice it gives the second derivative.
CurvePiece derivative(const CurvePiece& piece);

/// Points and weights of a quadrature on [0, 1].
struct Quadrature {
  Eigen::VectorXd points, weights;
};

/// The n-point Gauss-Legendre rule on [0, 1], exact for degree 2 n - 1; n >= 1.
Quadrature gauss_legendre(int n);

}  // namespace rheocyte
