// Isoelasticity lines and the range of the table as one recording sees them.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "events/options.h"
#include "measurement/recording.h"

namespace rheocyte {

/// {"lines": [{"young_modulus_kPa", "x", "y"}], "range": {"x", "y"}, "table", "sentence"}, those that `rheocyte plot`
/// with the same settings draws. Without lines, because the axes are not area_um and deform or the recording does not
/// say how it was measured, the sentence gives the reason. UserError if the table cannot be read.
nlohmann::ordered_json recording_lines(const Recording& recording, const ExtractOptions& options, const std::string& x,
                                       const std::string& y);

}  // namespace rheocyte
