// In what recordings differ that are compared as if their cells alone did.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "experiment/recording_report.h"

namespace rheocyte {

using RecordingReports = std::vector<const RecordingReport*>;

/// "channel width (20 and 30 um) and flow rate (0.04 and 0.16 ul/s)"; empty if they are measured alike. Temperatures
/// count from a degree on.
std::string differences_within(const RecordingReports& recordings);
/// The same of two groups, in what one of them has and the other has not.
std::string differences_between(const RecordingReports& some, const RecordingReports& others);
/// Whether stresses differ by flow rate and temperature alone.
bool share_channel_and_medium(const RecordingReports& recordings);

}  // namespace rheocyte
