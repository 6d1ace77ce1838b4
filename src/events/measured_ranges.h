// What the quantities of a set-up can be; others have a unit that was mistaken.
#pragma once
#include "case/key.h"

namespace rheocyte {

struct MeasuredRanges {
  Range channel_width_um, flow_rate_ul_s, pixel_size_um;
};
MeasuredRanges measured_ranges();

}  // namespace rheocyte
