// The surface of a cell off the axis, which turns like a tank tread through its shape: its velocity is that of the
// material that passes (docs/theory-square.md, eq:turning), and, on its way, that with which the shape changes
// (docs/theory-time.md, eq:turning-in-time).
//
// Each node of the surface has a velocity as an unknown; its equation says that it is the spin times the derivative of
// the current surface along the undeformed one's rotation, the mean of what the faces round the node say, and the rate
// of its displacement.
#pragma once
#include "duct/duct_space.h"
#include "fem/motion.h"
#include "fem/nested_lu.h"

namespace rheocyte {

/// Whether a hexahedron of the liquid has a face on the cell's surface.
inline bool touches_cell(const DuctElement& element) { return element.part == Part::layers && element.outward[0] == 0; }

class TurningSurface {
 public:
  /// The space must outlive this object. Nothing is added where the cell does not turn.
  explicit TurningSurface(const DuctSpace&);

  /// How displacements change; at first they rest.
  void set_motion(const Motion& motion) { motion_ = motion; }
  void add_residual(const VectorXd& unknowns, VectorXd& total) const;
  /// What the face of an element of the liquid adds to its matrix, whose rows and columns are numbered by `place`.
  void add_tangent(int element, const VectorXd& unknowns, const std::vector<int>& place, Eigen::MatrixXf& matrix) const;

 private:
  struct Face {
    std::vector<int> nodes;
    MatrixXd rate;      ///< d/dt at the nodes of what turns with the spin 1: nodes x nodes
    VectorXd fraction;  ///< one over the number of faces at a node
  };
  Face face_of(int element) const;
  double rate_of_displacement(int unknown, const VectorXd& unknowns) const;
  /// Velocity of the nodes at the spin 1.
  Eigen::MatrixX3d velocity(const Face&, const VectorXd& unknowns) const;

  const DuctSpace& space_;
  Motion motion_;
  std::vector<Face> faces_;
  std::vector<int> face_of_element_;  ///< -1: none
};

}  // namespace rheocyte
