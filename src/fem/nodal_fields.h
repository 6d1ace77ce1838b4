// All fields of a state at the nodes of an element, in physical units: what files and pictures are made from.
#pragma once

#include "fem/discretisation.h"
#include "laws/media.h"

namespace rheocyte {

/// Of an elastic stress.
double von_mises(Tensor<double> sigma);
/// Greatest principal stretch of a deformation gradient.
double max_stretch(const Tensor<double>& F);
/// sqrt(2 D:D) of a velocity gradient.
double shear_rate(const Tensor<double>& L);

/// Of one state; space, media and unknowns must outlive it.
class NodalFields {
 public:
  /// um, m/s, Pa, 1/s. The velocity relative to the cell is (wx, wr); stress, stretch and displacement (ux, ur) are
  /// those of the cell, shear stress and shear rate those of the liquid, 0 elsewhere.
  enum Column { x, r, vx, vr, wx, wr, pressure, stress, shear_stress, ux, ur, region, rate, stretch, columns };

  NodalFields(const Discretisation&, const Media&, const VectorXd& unknowns, const Scales&);

  /// Nodes x columns, the nodes of the reference element.
  MatrixXd of_element(int e) const;

 private:
  void add_liquid_stress(int e, MatrixXd& fields) const;
  void add_cell_stress(int e, MatrixXd& fields) const;
  MatrixXd in_liquid_interior(int e) const;
  /// Values at the quadrature points carried to the nodes: the Q_p function that fits them best.
  VectorXd at_nodes(const VectorXd& at_points) const;

  const Discretisation& space_;
  const Media& media_;
  const VectorXd& unknowns_;
  Scales scales_;
  MatrixXd to_nodes_;  ///< from the 1D quadrature points
};

}  // namespace rheocyte
