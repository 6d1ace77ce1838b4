// Many events as fewer that count several times.
#pragma once
#include <vector>

#include "population/sample.h"

namespace rheocyte {

struct BinWidths {
  double log_area, measure, log_viscosity;
};

/// One event for each bin with any, at the bin's middle in area and measure and the mean of its viscosities, ordered by
/// them. To the noise h^2 / 12 is to be added for both widths.
std::vector<SampleEvent> binned(const std::vector<SampleEvent>& events, const BinWidths& widths);

}  // namespace rheocyte
