// The two halves of a step of Mokbel et al. 2017, one after the other: liquid, then cell (docs/theory-time.md, sec. 3).
#pragma once
#include "fem/element_integrals.h"
#include "fem/subset_matrix.h"
#include "fem/surface_integrals.h"

namespace rheocyte {

/// What a step starts from. Velocities are those in the laboratory, (x, r) node by node.
struct SplitState {
  VectorXd unknowns;  ///< displacements, pressures, v_cell; velocities of the liquid relative to v_cell
  VectorXd velocities;
  VectorXd traction;          ///< that the cell feels, as loads in the equations of the surface's displacements
  double inlet_pressure = 0;  ///< where the inlet is open, beyond that of the undisturbed flow
};

class SplitSystem {
 public:
  /// The discretisation must outlive this object; its interior has to be elastic.
  explicit SplitSystem(const Discretisation&);

  /// The liquid after an implicit Euler step round the cell as it is and moves; sets `load` to the force on the
  /// surface, that of the cortex included. False if the matrix is singular.
  bool step_liquid(const Media&, double step, SplitState&, VectorXd& load);
  /// The cell's velocity after an implicit Euler step with the traction and the elastic stress of the present shape.
  bool step_cell(const Media&, double step, SplitState&);
  /// Moves the cell with its velocity relative to its mean, which becomes v_cell.
  void move(double step, SplitState&) const;

  /// Mean velocity over the volume of the cell.
  double mean_velocity(const SplitState&) const;
  int factorisations() const { return factorisations_; }

 private:
  void integrate_liquid(int element, const Media&, double step, const SplitState& before, const VectorXd& unknowns,
                        Want);
  void integrate_cell(int element, const Media&, double step, const SplitState&);
  void set_surface_velocity(const SplitState&);

  const Discretisation& space_;
  std::vector<ElementUnknowns> elements_;  ///< with the velocity of the surface as a known value
  VectorXd surface_velocity_;              ///< relative to v_cell, in the places of the displacements
  SurfaceIntegrals surface_;
  SubsetMatrix liquid_, cell_;
  ElementSystem element_;
  int factorisations_ = 0;
};

}  // namespace rheocyte
