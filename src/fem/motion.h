// What the system of a step in time knows of the steps before it (docs/theory-time.md, eq:bdf).
#pragma once
#include <Eigen/Core>

namespace rheocyte {

using Eigen::VectorXd;

/// How derivatives follow from new values within a time step: d(value)/dt = rate * value + history. All zero: at rest.
struct Motion {
  double rate = 0;
  VectorXd unknowns;    ///< histories of the unknowns
  VectorXd velocities;  ///< histories of the nodes' velocities, (x, r) node by node; in ducts none
  /// Rates at which a wall that is not straight moves the nodes outward; empty: straight. The space has its nodes
  /// there.
  VectorXd outward = {};
  VectorXd branch = {};  ///< histories of the branch's metric (eq:branch); empty: there is none
  /// Unknowns of a cell that turns, extrapolated to the end of the step: by these its material passes through the mesh
  /// (eq:turning-in-time); empty: it does not.
  VectorXd turning = {};
  VectorXd turning_branch =
      {};  ///< the branch's metric, extrapolated in the same way, which the material carries along
};

}  // namespace rheocyte
