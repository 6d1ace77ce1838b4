// A state at ever finer resolutions, and what its errors are by these (docs/theory.md, eq:error; docs/theory-square.md,
// eq:square-error).
#pragma once
#include <limits>
#include <memory>
#include <vector>

#include "solve/continuation.h"
#include "solve/number_errors.h"

namespace rheocyte {

class Discrete;

/// A state on the branch, how it was resolved, and how the way to it ended.
struct ResolvedState {
  Status status = Status::not_started;
  std::shared_ptr<Discrete> discrete;
  BranchState branch;  ///< its parameter is the compliance relative to the problem's
  double residual = 0;
  double turning = 0;    ///< of a `limit_point`: the compliance at which the branch turns
  bool gave_up = false;  ///< far from the requested cell, before the end was found exactly
};

/// How errors follow from the last rungs.
struct ErrorRule {
  double fraction_of_change_before = 0.5;  ///< of the change before the last one
  double fraction_of_first_change = 2;     ///< where there is no change before
  double min_of_two = 2e-5;                ///< no first change is trusted below this: neighbours may agree by chance
  /// Nor below this fraction of the change of the inertia ratio: two seldom do at once.
  double fraction_of_inertia = 0;
  /// Nor below this fraction of (1 - m)^2 times the change of the stability margin m: where the surface nears its limit
  /// deformations agree long before they are right.
  double fraction_of_margin = 0;
  double fraction_of_outline = 0;  ///< nor, in any change, below this fraction of the root mean square change of the
                                   ///< outline's modes
};

/// Error of the last of some values of the deformation on ever finer resolutions, relative to it
/// (docs/theory.md, eq:error).
double estimate_error(const std::vector<double>& deformations, const ErrorRule& = {});

/// Errors of smaller deformations are relative to this one. On the axis no deformation is resolved below
/// deformation_round_off. Off the axis less is asked: there a stiff cell's deformation is of second order, and far
/// below what a recording distinguishes from a sphere (docs/theory-square.md, sec. 6).
double deformation_floor(const Problem&);

/// A state at the resolutions of one mesh, coarse to fine; where the gap is narrow, of several.
struct Ladder {
  ErrorRule rule = {};
  std::vector<ResolvedState> rungs = {};
  std::vector<StateNumbers> numbers = {};                            ///< rung by rung
  double estimated_error = std::numeric_limits<double>::infinity();  ///< relative, of the last deformation

  void add(ResolvedState, const StateNumbers&);
  double deformation() const { return numbers.back().shape.deformation; }
  /// Of all numbers of the last rung, each in its unit.
  StateNumbers errors() const { return errors_of_last(numbers, estimated_error); }
  /// Of the last rung, as it is stated and judged, of what the problem wants accurately: of the deformation, relative
  /// to the floor where it is below that; or of the motion.
  double stated_error(const Problem&) const;
  /// The greatest relative error of the last velocity and spin, and of the drift at a given place; relative to 1e-4 of
  /// the velocity where it is less: so a cell would shift by 0.1 um on a way of 1 mm.
  double motion_error(CellPlace) const;
};

}  // namespace rheocyte
