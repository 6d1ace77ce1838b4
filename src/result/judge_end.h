// What can be said of the end of a computation in time: why it ended, what its surface went through, and how far it is
// from the stationary shape of the same cell.
#pragma once
#include "fem/work_limits.h"
#include "result/result.h"
#include "result/time_record.h"

namespace rheocyte {

/// Notes in the record why the run has ended, settles the status by its last state (`judged`), and says in the outcome
/// where its surface was compressed. Where the channel is straight from the end on, the stationary problem is solved
/// there on a mesh that is chosen for its accuracy; the outcome says how far the run's end is from it. Where the cell
/// has settled, the distance is the error of the run's mesh, and becomes the estimated error.
void judge_end(Result&, TimeRecord&, const WorkLimits&);

/// Whether so far (relative) from the stationary deformation nothing changes any more: over the last tenth of the time,
/// or a longer step, the deformation has changed by less than a tenth of the distance, or by less than the requested
/// accuracy.
bool has_settled(const TimeRecord&, double distance, double accuracy);

}  // namespace rheocyte
