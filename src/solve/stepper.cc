#include "solve/stepper.h"

#include "solve/rigid_start.h"

namespace rheocyte {

Stepper::Stepper(const Problem& problem, const Resolution& resolution)
    : problem_(with_elastic_interior(problem)),
      discrete_(std::make_shared<Discrete>(problem_, resolution)),
      media_(problem_) {}

}  // namespace rheocyte
