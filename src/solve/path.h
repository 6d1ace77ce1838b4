// One-parameter families of problems that a branch of states can be followed through.
#pragma once
#include <functional>
#include <memory>

#include "case/problem.h"
#include "fem/stationary_system.h"
#include "solve/resolution.h"

namespace rheocyte {

/// What fills the cell.
inline Interior interior_of(const Problem& problem) {
  if (problem.bulk.law == BulkLaw::none) return Interior::liquid;
  return problem.bulk.shear_modulus > 0 ? Interior::elastic : Interior::flowing;
}

/// The channel of a problem. Where its wall is not straight the mesh goes on beyond it.
inline ChannelGeometry geometry_of(const Problem& problem) {
  return ChannelGeometry(problem.radius_ratio, problem.channel_length, run_out(problem.wall));
}

/// Mesh, spaces and system of one resolution; they refer to each other and stay together.
struct Discrete {
  Discrete(const Problem&, const Resolution&);
  /// Becomes that of another problem, which may differ in the radius and in numbers of the laws: unknowns keep their
  /// order and meaning. The factors of the system stay.
  void move_to(const Problem&, const Resolution&);
  ChannelMesh mesh;
  Discretisation space;
  StationarySystem system;
};

/// Media as functions of a branch's parameter.
using MediaAt = std::function<Media(double)>;

/// Of a cell in which everything that is elastic is divided by the compliance.
MediaAt softening(const Media&);

/// Media, and the system if the geometry moves, as functions of the parameter.
struct Path {
  std::function<NonlinearSystem&(double)> system;
  MediaAt media;
  double end = 1;     ///< the wanted value
  double origin = 0;  ///< steps are limited relative to the distance from here; -infinity: not limited

  /// What changes of the parameter are measured in: the distance from the origin, 1 if there is none.
  double unit(double parameter) const;
};

/// From the rigid cell (0) to a compliance of 1. The system must outlive the path.
Path stiffness_path(NonlinearSystem&, MediaAt);
/// Everything that is elastic softens to what the problem says.
Path stiffness_path(NonlinearSystem&, const Problem&);

}  // namespace rheocyte
