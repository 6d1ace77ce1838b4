// Following the branch of stationary states from the rigid sphere to the wanted stiffness (docs/theory.md,
// eq:predictor). The parameter is the compliance c = wanted modulus / modulus: 0 is rigid, 1 is wanted.
#pragma once
#include <functional>

#include "case/problem.h"
#include "solve/newton.h"

namespace rheocyte {

/// Laws at a compliance in (0, 1]: every modulus, tension and stiffness of the cell is divided by it.
Media media_at(const Problem&, double compliance);

/// What fills the cell.
inline Interior interior_of(const Problem& problem) {
  return problem.bulk == BulkLaw::none ? Interior::liquid : Interior::elastic;
}

/// A converged state on the branch.
struct BranchState {
  double compliance = 0;
  VectorXd unknowns;
  VectorXd tangent;  ///< d(unknowns)/d(compliance); may be empty where a branch is entered
  int newton_iterations = 0;
};

struct ContinuationOptions {
  NewtonOptions newton;
  double displacement_per_step = 0.12;  ///< aim for the largest change of the surface in one step, in r0
  /// A predictor farther off than this may land on another branch: greatest change of the surface's meridional
  /// stretch by Newton. Strain, not displacement, shows a crease, which is short.
  double greatest_correction = 0.06;
  double least_step = 2e-3;  ///< of the compliance, relative to its value
  /// Called with each converged state; returning false refuses it as unstable, and the step is halved.
  std::function<bool(const Discretisation&, const BranchState&)> accept;
};

struct ContinuationReport {
  Status status = Status::not_started;
  BranchState last;  ///< the last converged state
  int steps = 0, newton_iterations = 0;
  double residual = 0;
};

/// First state on the branch: Newton from the sphere at a compliance where the response is still nearly linear.
ContinuationReport start_branch(StationarySystem&, const Problem&, const ContinuationOptions&);

/// Continues from a converged state to compliance 1 as far as it goes.
ContinuationReport continue_branch(StationarySystem&, const Problem&, const ContinuationOptions&, BranchState from);

}  // namespace rheocyte
