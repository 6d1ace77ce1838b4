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

/// Whether the estimated error is below the wanted one, or below what can be resolved of a tiny deformation. Where the
/// gap is narrow the coarsest mesh is not trusted: neighbouring degrees agree there although both are wrong.
bool is_accurate(const Ladder&, const Problem&);

/// Sees each state that is tried, and whether it became a rung.
using RungObserver = std::function<void(const ResolvedState&, const Ladder*)>;

/// Raises degree and mesh from a state, or from the ladder's last rung, until the error is small: status `converged`,
/// or why not. The ladder is the last one that was climbed.
Status climb(const Problem&, const NewtonOptions&, ResolvedState from, Ladder&, const RungObserver&);

}  // namespace rheocyte
