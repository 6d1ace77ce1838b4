// Random cells of all kinds, from stiff ones to such as are near the end of their branch, and their states at ever
// finer resolutions.
#pragma once
#include <array>
#include <cmath>
#include <random>

#include "case/problem.h"
#include "solve/resolved_branch.h"

namespace rheocyte::bench {

/// Of solids, solids under an axial tension, and solids in a cortex under tension, in a Newtonian or a shear-thinning
/// liquid. d is about 3 a^2.1 / (mu/S)^2, in a shear-thinning liquid a third of it.
inline Problem random_solid(Section section, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Problem problem;
  problem.section = section;
  problem.radius_ratio = 0.2 + 0.7 * uniform(random);
  const BulkLaw law =
      std::array{BulkLaw::linear, BulkLaw::neo_hookean, BulkLaw::mooney_rivlin}[std::size_t(3 * uniform(random))];
  const bool is_newtonian = uniform(random) < 0.5;
  if (!is_newtonian) problem.liquid = {.law = LiquidLaw::power_law, .exponent = 0.6};
  const double d = 2e-4 * std::pow(400, uniform(random));
  const double modulus = std::sqrt((is_newtonian ? 3 : 1) * std::pow(problem.radius_ratio, 2.1) / d);
  problem.bulk = {.law = law, .shear_modulus = modulus};
  const double kind = uniform(random), stiffness = modulus * problem.radius_ratio;
  if (kind < 0.25) {
    problem.bulk.axial_tension = 0.3 * modulus * uniform(random);
  } else if (kind < 0.5) {
    problem.cortex = {.law = CortexLaw::linear, .modulus = 2 * stiffness * uniform(random)};
    problem.cortex.tension = 0.3 * stiffness * uniform(random);
  }
  return problem;
}

/// The resolutions that a wanted accuracy takes, in a duct to a degree at most; none where there is no such cell.
inline Ladder climbed(Problem problem, double accuracy, int last_degree = 0) {
  problem.accuracy = accuracy;
  Geometry geometry = solver_geometry(problem);
  if (last_degree > 0) geometry.rungs.back().last_degree = last_degree;
  ResolvedBranch branch(problem, geometry);
  ResolvedState state = branch.follow();
  Ladder ladder{geometry.errors};
  if (state.status == Status::converged) branch.climb(state, ladder);
  if (std::ssize(ladder.rungs) < 2 || ladder.rungs.back().branch.parameter < 1) return {};
  return ladder;
}

}  // namespace rheocyte::bench
