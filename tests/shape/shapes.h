// Contours whose measures are known in closed form, interpolated at the Gauss-Lobatto points.
#pragma once
#include <cmath>
#include <functional>
#include <numbers>

#include "shape/curve.h"

namespace rheocyte::test {

/// A point (x, r) of the meridian at the angle theta from the front pole, 0 <= theta <= pi.
using Meridian = std::function<Eigen::Vector2d(double theta)>;

struct Resolution {
  int degree = 8;
  int pieces = 10;
};

inline Contour interpolate(const Meridian& meridian, Resolution resolution = {}) {
  Contour contour;
  const Eigen::VectorXd& nodes = lobatto_nodes(resolution.degree);
  for (int i = 0; i < resolution.pieces; ++i) {
    CurvePiece piece(resolution.degree + 1, 2);
    for (int k = 0; k <= resolution.degree; ++k)
      piece.row(k) = meridian(std::numbers::pi * (i + nodes(k)) / resolution.pieces).transpose();
    contour.pieces.push_back(piece);
  }
  contour.pieces.front()(0, 1) = 0;
  contour.pieces.back()(resolution.degree, 1) = 0;
  return contour;
}

inline Meridian ellipse(double half_length, double half_height) {
  return [=](double theta) { return Eigen::Vector2d(half_length * std::cos(theta), half_height * std::sin(theta)); };
}

/// radius(theta) times the direction theta.
inline Meridian polar(const std::function<double(double)>& radius) {
  return [=](double theta) -> Eigen::Vector2d {
    return radius(theta) * Eigen::Vector2d(std::cos(theta), std::sin(theta));
  };
}

/// A polygon through the given points (x, r), front to rear.
inline Contour polygon(const std::vector<Eigen::Vector2d>& corners) {
  Contour contour;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    CurvePiece piece(2, 2);
    piece << corners[i - 1].transpose(), corners[i].transpose();
    contour.pieces.push_back(piece);
  }
  return contour;
}

inline Contour transformed(Contour contour, double scale, double shift) {
  for (CurvePiece& piece : contour.pieces) {
    piece *= scale;
    piece.col(0).array() += shift;
  }
  return contour;
}

}  // namespace rheocyte::test
