// What a population says of the single events of a recording, as a companion that the field's programs open.
#pragma once
#include <filesystem>
#include <string>

#include "store/progress.h"

namespace rheocyte {

struct RecordingReport;

/// Writes the shrunken values of the events as features userdef0 to userdef9 that the recording does not use itself:
/// Young's modulus and radius, each with the standard deviation of its logarithm; NaN of events that were left out.
/// They are in no feature that other programs would test by (emodulus). What has no place, in words; empty if all has.
/// UserError: the recording cannot be read, or writing fails.
std::string write_population_companion(const std::filesystem::path& scratch, const RecordingReport& report,
                                       const TellProgress& on_progress);

}  // namespace rheocyte
