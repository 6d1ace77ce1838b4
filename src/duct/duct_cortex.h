// The cortex of a cell in a duct: what tension, shell and bending do on the surface's displacements, patch by patch
// (docs/theory-square.md, eq:membrane, eq:edge).
#pragma once
#include <array>

#include "duct/duct_integrals.h"
#include "laws/membrane_form.h"

namespace rheocyte {

class DuctCortex {
 public:
  /// Where it bends, faces that meet in an edge know each other. The space must outlive this object.
  DuctCortex(const DuctSpace&, bool bends);

  /// Patches that a layer's element has a part in: the face that it has in common with the cell, and where it bends,
  /// some of its edges.
  const std::vector<int>& patches_of(int element) const { return patches_of_element_[element]; }
  /// x, y, z of the patch's nodes: unknowns that move them, and those to whose equations their tests belong; -1: none.
  const Eigen::MatrixXi& unknowns_of(int patch) const { return patches_[patch].unknowns; }
  const Eigen::MatrixXi& equations_of(int patch) const { return patches_[patch].equations; }

  /// Residual and tangent of a patch, rows and columns as its unknowns.
  void integrate(int patch, const Cortex&, const VectorXd& unknowns, Want, ElementSystem&) const;

 private:
  /// A face, or the two that meet in an edge, which in a mirror plane are a face and its image; or the face of a liquid
  /// interior, whose pressure counts as the place x of one more node.
  struct Patch {
    MatrixXd rest;  ///< nodes x (x, y, z)
    Eigen::MatrixXi unknowns, equations;
    MatrixXd signs;                       ///< of the unknowns in the coordinates: an image may turn them
    VectorXd weights;                     ///< at the quadrature points
    std::vector<MatrixXd> parts;          ///< derivatives of the position: points x nodes each
    std::vector<RestMetric> rest_metric;  ///< of a face
    VectorXd rest_volume;                 ///< of a face of a liquid interior
  };
  struct Edge;
  Patch face_patch(int element, const std::vector<MatrixXd>& parts) const;
  Patch inflated_patch(const Patch& face) const;
  Patch edge_patch(const Edge& before, const Edge* behind) const;
  void append_nodes(int element, const Image&, Patch&) const;
  std::vector<Edge> edges_of(int element) const;
  Image mirror_at(const Edge&) const;
  void find_edges();
  template <int numbers, class Energy>
  void integrate(const Patch&, const Energy& energy_at, const VectorXd& unknowns, Want, ElementSystem&) const;

  const DuctSpace& space_;
  ReferenceElement<2> reference_;
  bool bends_;
  std::vector<Patch> patches_;
  std::vector<std::vector<int>> patches_of_element_;
};

}  // namespace rheocyte
