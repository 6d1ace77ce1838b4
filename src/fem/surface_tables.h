// What bending of the surface needs of the elements, on the meridian of the tube as on faces in ducts.
#pragma once
#include <array>

#include "fem/reference_element.h"

namespace rheocyte {

/// Values, slopes and second slopes of the functions of the nodes along an edge, at points in [0, 1].
inline std::array<MatrixXd, 3> edge_tables(const ReferenceElement<2>& reference, const VectorXd& at) {
  const MatrixXd slope = reference.lagrange_derivative(at);
  return {reference.lagrange(at), slope, slope * reference.lagrange_derivative(reference.nodes_1d)};
}

/// Of the interior penalty on angles of the surface: four times what an inverse inequality asks on equal elements.
inline double bending_penalty(const ReferenceElement<2>& reference) {
  constexpr double factor = 4;
  return factor * reference.degree() * reference.degree();
}

}  // namespace rheocyte
