// All that a computation in time needs to go on.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "fem/motion.h"
#include "solve/resolution.h"

namespace rheocyte {

/// A state at a time, in R/U. Velocities are those of the nodes, (x, r) node by node, relative to the frame;
/// in the splitting scheme those in the laboratory.
struct TimeLevel {
  double time = 0;
  Eigen::VectorXd unknowns, velocities;
  double frame_acceleration = 0;  ///< d(v_cell)/dt, in U^2/R
  double position = 0;            ///< of the frame along the channel, from the start of the cell, in R
  double barycentre = 0;          ///< of the cell in the frame; where it is held, 0
  double aside = 0;               ///< of the frame along the cell's offset, from where the mesh has it
  Eigen::VectorXd outward = {};   ///< where a wall that is not straight moves the mesh's nodes; empty: straight
  Eigen::VectorXd branch = {};    ///< metric of the Maxwell branch (eq:branch); empty: there is none

  /// Of the cell along the channel.
  double place() const { return position + barycentre; }
};

/// Where the factors come from that the next step begins with, where steps keep them: that of a step which may have
/// been refused. Unknowns empty: there are none.
struct KeptTangent {
  Motion motion;
  double axial_tension = 0, aside = 0;
  Eigen::VectorXd outward, unknowns;
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
  KeptTangent tangent = {};
};

}  // namespace rheocyte
