// Newton's method on the likelihood of a population.
#pragma once
#include <array>

#include "population/likelihood.h"

namespace rheocyte {

struct LikelihoodMaximum {
  LawVector q;
  double log_likelihood = 0;
  bool is_found = false;
  std::array<bool, law_parameters> at_bound{};
};

/// Which parameters are held where they are.
using HeldParameters = std::array<bool, law_parameters>;

/// From a start within the bounds, until the next step would gain less than 1e-5 in ln L. Far from the maximum the
/// events' scores tell the curvature, near it the observed information.
LikelihoodMaximum maximise(const PopulationLikelihood& likelihood, const LawVector& start,
                           const ParameterBounds& bounds, const HeldParameters& held = {});

/// Steps for differences: a tenth of a standard error each, as far as the events' scores tell it.
LawVector difference_steps(const LawMatrix& products);

}  // namespace rheocyte
