// A state at ever finer resolutions, until its estimated error is small (docs/theory.md, eq:error).
#pragma once
#include <limits>
#include <vector>

#include "solve/number_errors.h"
#include "solve/resolved_branch.h"

namespace rheocyte {

/// Error of the last of some values of the deformation on ever finer resolutions, relative to it
/// (docs/theory.md, eq:error).
double estimate_error(const std::vector<double>& deformations, double share_of_change_before = 0.5);

/// Errors of smaller deformations are relative to this one. On the axis no deformation is resolved below
/// deformation_round_off. Off the axis less is asked: there a stiff cell's deformation is of second order, and far
/// below what a recording tells from that of a sphere (docs/theory-square.md, sec. 6).
double deformation_floor(const Problem&);

/// An error relative to a deformation as it is stated and judged: relative to the floor below that.
double stated_error(const Problem&, double relative_error, double deformation);

/// A state at the resolutions of one mesh, coarse to fine; where the gap is narrow, of several.
struct Ladder {
  bool keeps_systems = true;  ///< of all rungs; or of the last one alone
  std::vector<ResolvedState> rungs = {};
  std::vector<double> deformations = {};                             ///< rung by rung
  std::vector<StateNumbers> numbers = {};                            ///< likewise
  double inertia_ratio = 1;                                          ///< of the last rung
  double estimated_error = std::numeric_limits<double>::infinity();  ///< relative, of the last deformation

  /// A state of the problem.
  void add(const Problem&, ResolvedState);
  /// Of all numbers of the last rung, each in its unit.
  StateNumbers errors() const { return errors_of_last(numbers, estimated_error); }
};

/// Whether the stated error is below the wanted one. Where the gap is narrow the coarsest mesh is not trusted:
/// neighbouring degrees agree there although both are wrong.
bool is_accurate(const Ladder&, const Problem&);

/// Sees each state that is tried, and whether it became a rung.
using RungObserver = std::function<void(const ResolvedState&, const Ladder*)>;

/// Raises degree and mesh from a state, or from the ladder's last rung, until the error is small: status `converged`,
/// or why not. The ladder is the last one that was climbed.
Status climb(const Problem&, const NewtonOptions&, ResolvedState from, Ladder&, const RungObserver&);

}  // namespace rheocyte
