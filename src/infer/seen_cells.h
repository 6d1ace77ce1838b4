// Cells of a recording as they were measured, and medians of several.
#pragma once
#include <cstddef>
#include <span>

#include "case/channel_flow.h"
#include "infer/bulk_cortex_fit.h"

namespace rheocyte {

/// The shape of a cell in pixels, or the median of several.
struct MeasuredCell {
  ShapeVector shape;
  ChannelFlow flow;
  std::size_t cells = 1;
};

/// The same with what is known of its errors.
struct SeenCell {
  MeasuredShape shape;
  ChannelFlow flow;
  std::size_t cells = 1;
};

/// The median of each feature and of the viscosity. At least one cell (asserted).
MeasuredCell median_of(std::span<const MeasuredCell> cells);

}  // namespace rheocyte
