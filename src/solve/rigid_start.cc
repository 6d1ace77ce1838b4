#include "solve/rigid_start.h"

#include <algorithm>
#include <cmath>

namespace rheocyte {
namespace {

/// So much stiffer than the flow that the displacement does not matter.
constexpr double rigid_modulus = 1e7;
constexpr double rigid_thinning_step = 0.1;

}  // namespace

Problem with_elastic_interior(Problem problem) {
  if (problem.bulk.law == BulkLaw::none) {
    problem.bulk.law = BulkLaw::neo_hookean;
    problem.bulk.shear_modulus = 0;
  }
  return problem;
}

Status flow_round_sphere(NonlinearSystem& system, const Media& media, const NewtonOptions& options,
                         VectorXd& unknowns) {
  unknowns = system.sphere();
  Media rigid = media;
  rigid.bulk = {.shear_modulus = rigid_modulus};
  rigid.cortex = {};
  // A power law is singular where nothing flows yet: from the Newtonian flow in steps.
  const int steps = std::max(1, int(std::ceil(thinning(media.liquid) / rigid_thinning_step - 1e-9)));
  for (int k = 1; k <= steps; ++k) {
    rigid.liquid = at_thinning(media.liquid, double(k) / steps);
    const NewtonReport report = newton(system, rigid, options, unknowns);
    if (report.status != Status::converged) return report.status;
  }
  system.scale_displacement(0, unknowns);
  return Status::converged;
}

}  // namespace rheocyte
