// The system of one time step in a duct, without inertia (docs/theory-time.md, sec. "the planar funnel").
#pragma once
#include "duct/duct_system.h"
#include "fem/motion.h"

namespace rheocyte {

/// Cell and liquid on their way: the counterpart of MovingSystem (fem/moving_system.h). The frame moves with the node
/// of the cell that is held, v_cell and, off the axis, the drift are its velocity. The interior has to be elastic,
/// the liquid's density zero.
class MovingDuctSystem final : public DuctSystem {
 public:
  /// The space must outlive this object. Where its walls move, `set_motion` follows them.
  explicit MovingDuctSystem(const DuctSpace&, double drop = 1, bool bends = false);

  void set_motion(const Motion&);

  /// The branch's metric of a state at the end of the step, at the quadrature points of the cell in turn, as its
  /// components xx, xy, xz, yy, yz, zz; and that of the unstressed branch.
  VectorXd branch_metric(const Bulk&, const VectorXd& unknowns) const;
  VectorXd unstressed_branch() const;

 private:
  const HexahedronUnknowns& unknowns_of(int element) const override { return elements_[element]; }
  void move_surface(int element);
  /// Of the nodes of an element of the undeformed ball, from its centre.
  Eigen::MatrixX3d places_in_ball(int element) const;
  void set_history(int element);
  /// Velocity with which the material passes through the nodes of an element of the cell at the spin 1
  /// (eq:turning-in-time), in the shape to which the motion extrapolates.
  Eigen::MatrixX3d turning_velocity(int element) const;
  void set_branch_history();
  /// What the turning does to the branch's metric where the material is (eq:branch-turning).
  void turn_branch(const VectorXd& metric);
  /// A metric at the quadrature points as a continuous function: its components at all nodes.
  MatrixXd branch_at_nodes(const VectorXd& metric) const;

  Motion motion_;
  std::vector<HexahedronUnknowns> elements_;
};

}  // namespace rheocyte
