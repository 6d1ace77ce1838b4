// The system of one time step (docs/theory-time.md, eq:momentum-time).
#pragma once
#include "fem/coupled_system.h"
#include "fem/motion.h"
#include "laws/moving_form.h"

namespace rheocyte {

/// Cell and liquid on their way. The cell's velocities are the derivatives of its displacements, in a frame that moves
/// with v_cell; on the surface they are the liquid's, too. The interior has to be `Interior::elastic` or, with
/// modulus zero, `Interior::flowing`.
class MovingSystem final : public CoupledSystem {
 public:
  /// The discretisation must outlive this object.
  explicit MovingSystem(const Discretisation&);

  void set_motion(const Motion&);

  /// Velocities relative to the frame, (x, r) node by node, of a state at the end of the step.
  VectorXd node_velocities(const VectorXd& unknowns) const;

  /// The branch's metric of a state at the end of the step, at the quadrature points of the cell in turn, as its
  /// components xx, xr, rr and hoop; and that of the unstressed branch.
  VectorXd branch_metric(const Bulk&, const VectorXd& unknowns) const;
  VectorXd unstressed_branch() const;

 private:
  void integrate(int element, const Media&, const VectorXd& unknowns, Want, ElementSystem&) const override;
  InletPressure inlet_pressure(const Media&) const override;
  void follow_nodes(int element);
  void move_surface_columns(int element);
  void set_liquid_history(int element);
  void set_cell_history(int element);
  void set_branch_history();

  Motion motion_;
  ShapeTable<2> ones_;                                      ///< of a column that is constant in space
  std::vector<std::vector<LiquidHistory>> liquid_history_;  ///< by elements and points; empty in the cell
  std::vector<std::vector<CellHistory<2>>> cell_history_;   ///< as above; empty in the liquid
};

}  // namespace rheocyte
