// The mesh on which a cell is followed in time (docs/theory-time.md, sec. "the mesh").
#pragma once
#include "case/problem.h"
#include "fem/work_limits.h"
#include "solve/resolution.h"

namespace rheocyte {

/// The highest degree that can be asked for (time.degree); in ducts memory and time grow faster with it.
inline constexpr int max_time_degree = 10, max_time_degree_in_ducts = 6;
inline int max_time_degree_of(const Problem& problem) {
  return is_duct(problem.section) ? max_time_degree_in_ducts : max_time_degree;
}

/// Resolves the stationary states of the paper's cells to 1e-5 of the deformation (docs/verification.md, sec. 9).
inline constexpr Resolution usual_time_resolution = {{2, 4, 1, 2}, 6};
/// Those of a cell of 6 um and 4 kPa to 5e-4 (docs/theory-square.md).
inline constexpr Resolution usual_time_resolution_in_ducts = {{}, 4};
inline Resolution usual_time_resolution_of(const Problem& problem) {
  return is_duct(problem.section) ? usual_time_resolution_in_ducts : usual_time_resolution;
}

/// The coarsest resolution on which the stationary deformation of the same cell, in the narrowest part of its channel,
/// is right within half of the accuracy (relative). The usual one where there is no such shape.
Resolution resolution_in_time(const Problem&, double accuracy, const WorkLimits& limits);

/// One that is a degree coarser (finer where there is no coarser one), to compare with.
Resolution to_compare_with(const Problem&, const Resolution&);

}  // namespace rheocyte
