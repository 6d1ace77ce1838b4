// Following a branch by its arc length, which goes round folds where the parameter turns back
// (docs/theory.md, eq:arclength).
#pragma once
#include "solve/continuation.h"

namespace rheocyte {

struct ArcOptions {
  NewtonOptions newton;
  /// Of the arc, sqrt(mean square displacement of the surface / r0^2 + (step of the parameter / its unit)^2).
  double first_step = 0.02, min_step = 1e-4, max_step = 0.05;
  double max_correction = 0.06;  ///< as in ContinuationOptions
  int step_limit = 50;
  /// Sees each converged state; returning false ends the trace there.
  std::function<bool(const Discretisation&, const BranchState&)> go_on;
};

/// What a trace found.
struct ArcReport {
  Status status = Status::not_started;  ///< converged: `go_on` or the step limit ended it
  std::vector<BranchState> states;      ///< the first one included; their tangents are d/d(arc)
  /// States where d(parameter)/d(arc) changes its sign: indices of the last state before.
  std::vector<int> folds;
};

/// Traces a path whose geometry does not change from a converged state, at first towards greater parameters.
ArcReport trace_arc(const Path&, const ArcOptions&, BranchState from);

}  // namespace rheocyte
