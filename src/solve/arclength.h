// Following a branch by its arc length, which goes round folds where the parameter turns back
// (docs/theory.md, eq:arclength).
#pragma once
#include <functional>
#include <limits>
#include <vector>

#include "solve/continuation.h"

namespace rheocyte {

struct ArcOptions {
  NewtonOptions newton;
  /// Of the arc: the norm of the change of unknowns and parameter, in which the first tangent is as long as its largest
  /// displacement in r0.
  double first_step = 0.02, min_step = 1e-4, max_step = 0.05;
  double max_correction = 0.06;  ///< as in ContinuationOptions
  int step_limit = 50;
  int fold_limit = std::numeric_limits<int>::max();  ///< so many folds end the trace, as success
  /// Sees each converged state; returning false ends the trace there, as success.
  std::function<bool(const BranchState&)> go_on;
};

/// What a trace found.
struct ArcReport {
  Status status = Status::not_started;  ///< converged: a limit or `go_on` ended it
  std::vector<BranchState> states;      ///< the first one included; their tangents are d/d(arc)
  std::vector<double> arcs;             ///< from the first state
  std::vector<double> slopes;           ///< d(parameter)/d(arc)
  /// States where the slope changes its sign: indices of the last state before.
  std::vector<int> folds;
  int newton_iterations = 0;
};

/// Traces a path whose geometry does not change from a converged state, at first towards greater parameters.
ArcReport trace_arc(const Path&, const ArcOptions&, BranchState from);

/// The parameter at which the branch turns between two states beside a fold, by the slopes there.
double turning_parameter(const ArcReport&, int fold);

}  // namespace rheocyte
