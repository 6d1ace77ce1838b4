// Newton's method on a system of equations, with chord steps while a kept factorisation still contracts well.
#pragma once
#include <atomic>
#include <vector>

#include "fem/nonlinear_system.h"
#include "state/outcome.h"

namespace rheocyte {

struct NewtonOptions {
  double tolerance = 1e-11;  ///< of the residual, relative to that of the undeformed sphere in a liquid at rest
  int iteration_limit = 12;  ///< factorisations
  bool chord_steps = true;   ///< reuse a factorisation while each step reduces the residual enough
  /// A chord step has to reduce the residual by this factor, or the tangent is renewed.
  double chord_reduction = 0.1;
  bool keep_factors = false;  ///< begin with chord steps with the factors that the system holds, of a state nearby
  /// > 0: where a factorisation takes as long as so many chord steps, these learn from the last ones (ResidualMixing,
  /// chord_mixing.h), and go on while no more than this are to be expected; in place of chord_reduction.
  int chord_limit = 0;
  double residual_scale = 0;  ///< what residuals are relative to; 0: the function below
  const std::atomic<bool>* stop = nullptr;
};

struct NewtonReport {
  Status status = Status::not_started;
  int iterations = 0;                    ///< steps, chord steps included
  double residual = 0;                   ///< relative, of the last state
  std::vector<double> residual_history;  ///< relative, before each step and at the end
  double first_correction = 0;           ///< largest displacement of the first step, in R
  VectorXd factored_at = {};             ///< unknowns of the last factorisation; empty: there was none
};

/// Norm of the residual of the undeformed sphere in a liquid at rest: the scale of the driving forces.
double residual_scale(NonlinearSystem&, const Media&);

/// Improves `unknowns` in place. If the report is not `converged`, `unknowns` are unspecified; the caller keeps the
/// last good state. The system keeps the last factorisation.
NewtonReport newton(NonlinearSystem&, const Media&, const NewtonOptions&, VectorXd& unknowns);

}  // namespace rheocyte
