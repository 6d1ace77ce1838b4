// What events say of themselves as JSON: the liquid of a case, and numbers that may be missing.
#pragma once
#include <nlohmann/json.hpp>

#include "case/channel_flow.h"

namespace rheocyte {

/// The section [flow] of a case.
nlohmann::ordered_json flow_json(const ChannelFlow&);

/// Null where the value is not a finite number.
nlohmann::ordered_json number_or_null(double value);

}  // namespace rheocyte
