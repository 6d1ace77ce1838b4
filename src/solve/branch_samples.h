// Some states of one branch, from stiff to soft (docs/theory-square.md, sec. "States of a table").
#pragma once
#include <span>
#include <vector>

#include "solve/path.h"
#include "solve/stationary.h"

namespace rheocyte {

/// States from stiff to soft, each at the compliance outcome.reached. They write no fields.
struct BranchSamples {
  std::vector<StationaryState> states;
  Status end = Status::not_started;  ///< why the branch goes no farther; converged: it passes the greatest deformation
};

/// How far a branch is followed, and which of its states are requested.
struct SamplingWay {
  double max_deformation = 1;
  double least_margin = 0;      ///< of the surface from its limit (surface_stability.h)
  std::vector<double> heights;  ///< of the states; ascending, the last one 1
  /// What heights are fractions of, at the last state: the root of the deformation, or the compliance where cells are
  /// deformed by something else than the flow, too.
  enum class Height { root_of_deformation, compliance };
  Height height = Height::root_of_deformation;
  double first_compliance = 0;  ///< before it no state is requested: there the way may lead from the sphere
};

/// The branch of a problem, whose media are those given at a compliance of 1, is followed from the sphere to its end,
/// or a little past the greatest deformation d, or to where its surface has the least margin (end: surface_unstable).
/// Then it has one state for each height (met within some per cent), with a stable surface at all degrees. Those above
/// a height of 0.6 are as accurate as the problem says, the others where the finest mesh allows. Without states if
/// there are none such, and when it was stopped.
BranchSamples branch_samples(const Problem&, const MediaAt&, const SamplingWay&,
                             const std::atomic<bool>* stop = nullptr);

}  // namespace rheocyte
