// A mesh that fits round a deformed cell: of all meshes with the same boundary it is the one that is least distorted
// (docs/theory.md, eq:distortion).
#pragma once
#include <array>
#include <vector>

#include "fem/reference_element.h"

namespace rheocyte {

/// A mesh whose nodes may move. Elements list their nodes, first coordinate fastest.
template <int dim>
struct MovableMesh {
  const ReferenceElement<dim>& reference;
  std::vector<std::vector<int>> elements;
  MatrixXd rest;  ///< where the nodes are in the mesh that would be the best one: nodes x dim
  /// Of each node's components: numbers from 0 on, the same one for components that move together; fixed: -1.
  std::vector<std::array<int, dim>> unknown;
  int unknowns = 0;
};

/// The inverse of the greatest distortion at a point: 1 where the mesh is similar to that at rest, 0 where it is
/// folded.
template <int dim>
double mesh_quality(const MovableMesh<dim>&, const MatrixXd& places);

/// The nodes' places in the least distorted mesh, from those in one that is not folded; as they are, if it is.
template <int dim>
MatrixXd fitted_places(const MovableMesh<dim>&, MatrixXd places);

}  // namespace rheocyte
