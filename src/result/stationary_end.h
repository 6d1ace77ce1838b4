// What the end of a computation in time can be compared with: the stationary shape of the same cell, on a mesh that was
// chosen for its accuracy.
#pragma once
#include <atomic>

#include "result/result.h"
#include "result/time_record.h"

namespace rheocyte {

/// Solves the stationary problem of a run that has come to its end in a straight channel, notes its deformation in the
/// record and says in the outcome how far the run's end is from it. Where the cell has settled, the distance is the
/// error of the run's mesh, and becomes the estimated error.
void compare_with_stationary(Result&, TimeRecord&, const std::atomic<bool>& stop);

/// Whether so far (relative) from the stationary deformation nothing changes any more: over the last tenth of the time,
/// or a longer step, the deformation has changed by less than a tenth of the distance, or by less than the wanted
/// accuracy.
bool has_settled(const TimeRecord&, double distance, double accuracy);

}  // namespace rheocyte
