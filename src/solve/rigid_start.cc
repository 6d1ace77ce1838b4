#include "solve/rigid_start.h"

#include <algorithm>

#include "fem/observe.h"

namespace rheocyte {
namespace {

/// So much stiffer than the flow that the displacement does not matter.
constexpr double rigid_modulus = 1e7;
constexpr double exponent_step = 0.1;

}  // namespace

Problem with_elastic_interior(Problem problem) {
  if (problem.bulk.law == BulkLaw::none) {
    problem.bulk.law = BulkLaw::neo_hookean;
    problem.bulk.shear_modulus = 0;
  }
  return problem;
}

Status flow_round_sphere(MovingSystem& system, const Media& media, const NewtonOptions& options, VectorXd& unknowns) {
  unknowns = system.sphere();
  Media rigid = media;
  rigid.bulk = {.shear_modulus = rigid_modulus};
  rigid.cortex = {};
  double exponent = 1;
  do {  // a power law is singular where nothing flows yet: from the Newtonian flow in steps of its exponent
    const double wanted = media.liquid.exponent;
    exponent += std::clamp(wanted - exponent, -exponent_step, exponent_step);
    rigid.liquid.exponent = exponent;
    const NewtonReport report = newton(system, rigid, options, unknowns);
    if (report.status != Status::converged) return report.status;
  } while (exponent != media.liquid.exponent);
  scale_displacement(system.space(), 0, unknowns);
  return Status::converged;
}

}  // namespace rheocyte
