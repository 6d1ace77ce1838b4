// The cortex of a cell in a duct: what tension and shell do on the surface's displacements, face by face
// (docs/theory-square.md, eq:membrane).
#pragma once
#include "duct/duct_integrals.h"
#include "laws/membrane_form.h"

namespace rheocyte {

/// Residual and tangent of a face: components x, y, z of its nodes.
struct FaceSystem {
  VectorXd residual;
  MatrixXd tangent;
};

class DuctCortex {
 public:
  /// The space must outlive this object.
  explicit DuctCortex(const DuctSpace&);

  /// The face that a layer's element shares with the cell, -1 if none.
  int face_of(int element) const { return face_of_element_[element]; }
  /// Unknowns whose values move the nodes, -1 where fixed; and whose equations their tests belong to.
  std::vector<int> unknowns_of(int face) const;

  void integrate(int face, const Cortex&, const VectorXd& unknowns, Want, FaceSystem&) const;

 private:
  struct Face {
    std::vector<int> nodes;
    std::vector<SurfaceMetric<double>> rest;  ///< at the quadrature points
  };
  MatrixXd positions(const Face&, const VectorXd& unknowns) const;

  const DuctSpace& space_;
  ReferenceElement<2> reference_;
  std::vector<Face> faces_;
  std::vector<int> face_of_element_;
};

}  // namespace rheocyte
