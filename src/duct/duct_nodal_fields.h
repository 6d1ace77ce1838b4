// All fields of a state in the duct at the nodes of a hexahedron, in physical units.
#pragma once
#include "duct/duct_integrals.h"

namespace rheocyte {

/// Of one state; space, media and unknowns must outlive it.
class DuctNodalFields {
 public:
  /// um, m/s, Pa, 1/s, as in NodalFields (fem/nodal_fields.h); x, v, w and u take three columns.
  enum Column { x = 0, v = 3, w = 6, u = 9, pressure = 12, stress, shear_stress, region, rate, stretch, columns };

  DuctNodalFields(const DuctSpace&, const Media&, const VectorXd& unknowns, const Scales&);

  /// Nodes x columns.
  MatrixXd of_element(int e) const;

 private:
  void add_liquid_stress(int e, MatrixXd& fields) const;
  void add_cell_stress(int e, MatrixXd& fields) const;
  VectorXd at_nodes(const VectorXd& at_points) const;

  const DuctSpace& space_;
  const Media& media_;
  const VectorXd& unknowns_;
  Scales scales_;
  TensorElement element_;
  MatrixXd to_nodes_;  ///< in each direction: the polynomial that fits best
};

}  // namespace rheocyte
