// Some states of one branch in a square duct (docs/theory-square.md, sec. "States of a table").
#pragma once
#include <span>
#include <vector>

#include "solve/path.h"
#include "solve/stationary.h"

namespace rheocyte {

/// States from stiff to soft, each at the compliance outcome.reached. They write no fields.
struct DuctBranch {
  std::vector<StationaryState> states;
  Status end = Status::not_started;  ///< why the branch goes no farther; converged: it passes the greatest deformation
};

/// The branch of a problem, whose media are those given at a compliance of 1, is followed from the sphere to its end,
/// or a little past the greatest deformation d, or to where its surface is closer to its limit than the least margin
/// (surface_stability.h; end: surface_unstable). Then it has one state for each height, a share of sqrt(d) at the last
/// state (ascending, the last one 1; met within some per cent), with a stable surface at all degrees. Those above a
/// height of 0.6 are as accurate as the problem says, the others where the finest mesh allows. Without states if there
/// are none such, and when it was stopped.
DuctBranch follow_in_duct(const Problem&, const MediaAt&, double max_deformation, std::span<const double> heights,
                          double least_margin = 0, const std::atomic<bool>* stop = nullptr);

}  // namespace rheocyte
