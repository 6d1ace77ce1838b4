// The way of a cell from the sphere, with everything that is recorded on it (docs/theory-time.md).
#pragma once
#include <cmath>

#include "solve/stationary.h"
#include "solve/time_start.h"

namespace rheocyte {

/// Times in R/U, places from the start of the cell, in R.
struct TimeRun {
  double end = 1;             ///< HUGE_VAL: at the place alone
  double output_every = 0.1;  ///< time, or way, between outputs
  double accuracy = 1e-5;     ///< of the surface's positions in each step, in r0
  int degree = 0;             ///< 0: chosen with the mesh
  TimeScheme scheme = TimeScheme::monolithic;
  double step = 2e-3;        ///< of the splitting scheme
  int surface_elements = 0;  ///< of the splitting scheme; 0: the mesh of the implicit steps
  double end_position = HUGE_VAL;
  bool outputs_by_place = false;
  double mesh_accuracy = 1e-3;   ///< of the deformation, relative; where the mesh is chosen
  bool estimates_error = false;  ///< by a second run on a coarser mesh, unless the cell has settled
  double first_output = 0;       ///< time, or way, of the first output behind the start; 0: output_every
};

/// How far before its wanted end a run by place may end: in a duct the place is the barycentre's, which is known as
/// accurately as a step is.
inline double place_tolerance(const Problem& problem, const TimeRun& run) {
  return is_duct(problem.section) ? run.accuracy * problem.radius_ratio : 0;
}

/// What is recorded of each step; dimensionless.
struct TimePoint {
  double time = 0, step = 0;
  int order = 0, newton_iterations = 0, refused_steps = 0;
  double position = 0;  ///< of the cell along the channel, from its start
  StateNumbers state;
};

/// What is recorded at the outputs; interpolated between steps.
struct TimeFrame {
  double time = 0;
  double position = 0;
  StationaryState state;  ///< its fields are there as long as the observer is being called: then the walls move on
};

struct TimeObserver {
  std::function<void(const TimeFrame&)> frame;                   ///< at 0, output_every, 2 output_every, ..., the end
  std::function<void(const TimePoint&, const TimeState&)> step;  ///< at the start and after each step and its frames
  /// All steps of the same run on another mesh, from which the errors are, if there is one that tells them.
  std::function<void(std::span<const TimePoint>)> compared = {};
};

/// Follows the cell from the sphere, or from the state of an earlier run on the mesh of that. The result describes the
/// last state; its `reached` is 1 as the moduli are the wanted ones throughout. Never throws for a numerical failure.
StationaryState transient(const Problem&, const TimeRun&, const TimeObserver&, const TimeStart* from = nullptr,
                          const WorkLimits& limits = {});

}  // namespace rheocyte
