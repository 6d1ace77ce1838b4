// A branch state at one resolution, and the way to the next finer one.
#pragma once
#include <memory>

#include "fem/observe.h"
#include "solve/continuation.h"
#include "solve/surface_stability.h"

namespace rheocyte {

/// A state on the branch, how it was resolved, and how the way to it ended.
struct ResolvedState {
  Status status = Status::not_started;
  std::shared_ptr<Discrete> discrete;
  Resolution resolution;
  BranchState branch;
  double residual = 0;
  int steps = 0, newton_iterations = 0;  ///< of the way to it
  WorkMeter work;                        ///< of the whole way, systems that were left included
  bool gave_up = false;                  ///< far from the wanted cell, before the end was found exactly
};

/// Sees each converged state of the way.
using BranchObserver = std::function<void(const Discretisation&, const BranchState&)>;

/// How hard the end of a branch is looked for. Thorough: on all resolutions, to 0.2 % of the compliance. Hopeful: not
/// on the fine ones, which only see a little more of the branch, if the coarse ones end far from the wanted cell.
/// Quick: on the coarse ones alone, where the end is known anyway.
enum class Search { thorough, hopeful, quick };

/// Follows the branch from the sphere to compliance 1, first on a coarse resolution; where that fails, it goes on from
/// the last state on finer ones. States whose surface is beyond Biot's limit are not accepted.
ResolvedState follow_branch(const Problem&, const NewtonOptions&, const BranchObserver&, Search = Search::thorough);

/// The same state at another resolution; if Newton leaves it, the branch is followed anew there.
ResolvedState at_resolution(const Problem&, const NewtonOptions&, const ResolvedState& from, const Resolution&);

}  // namespace rheocyte
