// Following a branch of stationary states along a path (docs/theory.md, eq:predictor).
#pragma once
#include <functional>

#include "case/problem.h"
#include "solve/newton.h"
#include "solve/path.h"

namespace rheocyte {

/// First corrections of Newton's method, in the cell's radius, that steps aim at.
inline constexpr double max_aim = 0.01, min_aim = 1e-4;

/// A converged state on the branch.
struct BranchState {
  double parameter = 0;  ///< of the path: the compliance, or the fraction of the way between two problems
  VectorXd unknowns;
  VectorXd tangent;  ///< d(unknowns)/d(parameter); may be empty where a branch is entered
  int newton_iterations = 0;
  /// With which a branch goes on from here: the step of the parameter, 0 if it is not known, and the first correction
  /// that steps aim at, less after one that failed.
  double step = 0, aim = max_aim;
};

struct ContinuationOptions {
  NewtonOptions newton;
  double displacement_per_step = 0.12;  ///< aim for the largest change of the surface in one step, in r0
  /// A predictor farther off than this may land on another branch: greatest change of the surface's meridional
  /// stretch by Newton. Strain, not displacement, shows a crease, which is short.
  double max_correction = 0.06;
  double min_step = 2e-3;  ///< of the parameter, relative to its distance from the path's origin (or to 1)
  /// Called with each converged state; returning false refuses it as unstable, and the step is halved.
  std::function<bool(const NonlinearSystem&, const BranchState&)> accept;
  /// Whether the way is to end at an accepted state, as converged.
  std::function<bool(const BranchState&)> pause;
};

struct ContinuationReport {
  Status status = Status::not_started;
  BranchState last;  ///< the last converged state
  int steps = 0, newton_iterations = 0;
  double residual = 0;
};

/// First state of a branch in the compliance (`stiffness_path`): Newton from the sphere where the response is still
/// nearly linear.
ContinuationReport start_branch(const Path&, const ContinuationOptions&);

/// Continues from a converged state to the end of the path as far as it goes.
ContinuationReport continue_branch(const Path&, const ContinuationOptions&, BranchState from);

/// d(unknowns)/d(parameter) at a state, with the factorisation that the system of its parameter holds.
VectorXd branch_tangent(const Path&, const BranchState&);

/// d(residual)/d(parameter) at a state.
VectorXd parameter_slope(const Path&, const BranchState&);

}  // namespace rheocyte
