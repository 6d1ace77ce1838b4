// The way of a cell from the sphere, with everything that is recorded on it (docs/theory-time.md).
#pragma once
#include <cmath>

#include "solve/stationary.h"
#include "solve/time_start.h"
#include "solve/time_way.h"

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
  bool estimates_error = false;  ///< by the same run with other steps, and on other meshes (solve/time_errors.h)
  double first_output = 0;       ///< time, or way, of the first output behind the start; 0: output_every
  double step_factor = 1;        ///< first and longest steps over the usual ones
  bool ends_when_settled = true;
};

/// Whether the user has chosen the mesh; then no accuracy is requested of it.
inline bool is_mesh_given(const TimeRun& run) { return run.degree > 0 || run.scheme == TimeScheme::partitioned; }

/// How far before its wanted end a run by place may end: in a duct the place is the barycentre's, which is known as
/// accurately as a step is.
inline double tolerance_of_place(const Problem& problem, const TimeRun& run) {
  return is_duct(problem.section) ? run.accuracy * problem.radius_ratio : 0;
}

/// What is recorded at the outputs; interpolated between steps.
struct TimeFrame {
  double time = 0;
  double position = 0;
  StationaryState state;  ///< its fields are there as long as the observer is being called: then the walls move on
};

struct TimeObserver {
  std::function<void(const TimeFrame&)> frame;                   ///< at 0, output_every, 2 output_every, ..., the end
  std::function<void(const TimePoint&, const TimeState&)> step;  ///< at the start and after each step and its frames
  std::function<void(const TimeWay&)> errors = {};               ///< of all steps and outputs, once they are known
};

/// Follows the cell from the sphere, or from the state of an earlier run on the mesh of that. The result describes the
/// last state; its `reached` is 1 as the moduli are the wanted ones throughout. Never throws for a numerical failure.
StationaryState transient(const Problem&, const TimeRun&, const TimeObserver&, const TimeStart* from = nullptr,
                          const WorkLimits& limits = {});

}  // namespace rheocyte
