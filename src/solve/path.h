// One-parameter families of problems that a branch of states can be followed through.
#pragma once
#include <functional>

#include "case/problem.h"
#include "fem/nonlinear_system.h"

namespace rheocyte {

/// Media as functions of a branch's parameter.
using MediaAt = std::function<Media(double)>;

/// Of a cell in which everything that is elastic is divided by the compliance.
MediaAt softening(const Media&);

/// Media, and the system if the geometry moves, as functions of the parameter.
struct Path {
  std::function<NonlinearSystem&(double)> system;
  MediaAt media;
  double end = 1;     ///< the requested value
  double origin = 0;  ///< steps are limited relative to the distance from here; -infinity: not limited

  /// What changes of the parameter are measured in: the distance from the origin, 1 if there is none.
  double unit(double parameter) const;
};

/// From the rigid cell (0) to a compliance of 1. The system must outlive the path.
Path stiffness_path(NonlinearSystem&, MediaAt);
/// Everything that is elastic softens to what the problem says.
Path stiffness_path(NonlinearSystem&, const Problem&);

}  // namespace rheocyte
