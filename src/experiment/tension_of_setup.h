// Whether recordings of one set-up have one axial tension of the liquid: it belongs to the medium, the channel and the
// flow, not to the cells (docs/real-cells.md).
#pragma once
#include <string>
#include <vector>

#include "experiment/recording_report.h"

namespace rheocyte {

/// One sentence for each set-up of at least three recordings that have a tension.
std::vector<std::string> tensions_of_setups(const std::vector<RecordingReport>& recordings);

}  // namespace rheocyte
