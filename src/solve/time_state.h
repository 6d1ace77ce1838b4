// All that a computation in time needs to go on.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "solve/resolution.h"

namespace rheocyte {

/// A state at a time, in R/U. Velocities are those of the nodes, (x, r) node by node, relative to the frame;
/// in the splitting scheme those in the laboratory.
struct TimeLevel {
  double time = 0;
  Eigen::VectorXd unknowns, velocities;
  double frame_acceleration = 0;  ///< d(v_cell)/dt, in U^2/R
  double position = 0;            ///< of the cell's barycentre along the channel, from its start, in R
  Eigen::VectorXd outward = {};   ///< where a wall that is not straight moves the mesh's nodes; empty: straight
  Eigen::VectorXd branch = {};    ///< metric of the Maxwell branch (fem/moving_system.h); empty: there is none
};

/// All that the next step depends on.
struct TimeState {
  std::vector<TimeLevel> levels;  ///< the latest first
  int order = 1;                  ///< of the next step
  int steps_at_order = 0;
  double next_step = 0;
  Eigen::VectorXd traction;   ///< on the cell, of the splitting scheme only (fem/split_system.h)
  double inlet_pressure = 0;  ///< beyond that of the undisturbed flow; only where it is controlled
  Resolution resolution = {};
};

}  // namespace rheocyte
