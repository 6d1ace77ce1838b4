// What is told of a stationary state in a duct.
#pragma once
#include <memory>

#include "duct/duct_system.h"
#include "duct/observe_duct.h"
#include "solve/path.h"
#include "solve/stationary.h"

namespace rheocyte {

/// The duct as the mesh has it: a cell off the axis is so along y, which the camera's direction becomes.
DuctShape shape_of(const Problem&);
Symmetry symmetry_of(const Problem&);
Camera camera_in_mesh(const Problem&);
DuctSubdivision subdivision_of(const Problem&);

/// Space and system of one resolution. The space may be held for longer than the system, whose factors are large.
struct DuctDiscrete {
  DuctDiscrete(const Problem& problem, const DuctSubdivision& subdivision, int degree)
      : DuctDiscrete(problem, subdivision, degree, symmetry_of(problem)) {}
  DuctDiscrete(const Problem& problem, const DuctSubdivision& subdivision, int degree, Symmetry symmetry)
      : shared_space(std::make_shared<const DuctSpace>(DuctMesh(DuctGeometry(shape_of(problem)), subdivision, symmetry),
                                                       degree, problem.liquid, problem.drive, interior_of(problem))),
        space(*shared_space),
        system(space,
               problem.drive == Drive::rate
                   ? 1
                   : problem.pressure_gradient / space.section().flow(problem.liquid).pressure_gradient,
               problem.cortex.bending > 0) {}
  std::shared_ptr<const DuctSpace> shared_space;
  const DuctSpace& space;
  DuctSystem system;
};

/// Deformation of the silhouette that the camera sees.
double duct_deformation(const DuctSpace&, const VectorXd& unknowns, Camera);

/// Distance of the surface from short wrinkles, as in the tube, by the least principal stretch and tension anywhere
/// (docs/theory-square.md, eq:square-biot).
double duct_stability_margin(const Problem&, const DuctSpace&, const VectorXd& unknowns);

/// All numbers of a state of this problem.
StateNumbers duct_numbers(const Problem&, const DuctDiscrete&, const VectorXd& unknowns);

/// Fills in contours, surface, numbers, sizes and the writer of fields of a state of this problem; outcome, errors and
/// counts of work are left alone.
void describe_duct(const Problem&, const DuctDiscrete&, const VectorXd& unknowns, StationaryState&);

}  // namespace rheocyte
