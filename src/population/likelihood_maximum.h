// Newton's method on the likelihood of a population.
#pragma once
#include <array>
#include <optional>

#include "population/likelihood.h"

namespace rheocyte {

struct LikelihoodMaximum {
  LawVector q;
  double log_likelihood = 0;
  LawMatrix products = LawMatrix::Zero();  ///< of the events' scores there
  bool is_found = false;
  std::array<bool, law_parameters> at_bound{};
};

/// Which parameters are held where they are.
using HeldParameters = std::array<bool, law_parameters>;

/// From a start within the bounds, until the next step would gain less than 1e-7 in ln L. Far from the maximum the
/// events' scores give the curvature, near it the observed information, which is kept in `information` as long as its
/// steps lead on: it may be that of an earlier search nearby.
LikelihoodMaximum maximise(const PopulationLikelihood& likelihood, const LawVector& start,
                           const ParameterBounds& bounds, const HeldParameters& held,
                           std::optional<LawMatrix>& information);

/// Steps for differences: a tenth of a standard error each, as far as the events' scores give it.
LawVector difference_steps(const LawMatrix& products);

}  // namespace rheocyte
