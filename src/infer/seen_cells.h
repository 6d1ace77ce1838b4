// Cells of a recording as they were measured, and means of several of them.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "case/channel_flow.h"
#include "infer/several_moduli.h"

namespace rheocyte {

/// The shape of a cell in pixels, or the mean of several.
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

/// The mean of each feature without strangers, and of the viscosity. At least one cell (asserted).
MeasuredCell mean_of(std::span<const MeasuredCell> cells);

/// Of groups of equal count and of neighbouring sizes. The scatter of pixels hardly moves what is fitted to them, where
/// it would move the mean of single fits: moduli depend on shapes in a bent way.
std::vector<MeasuredCell> means_by_size(std::span<const MeasuredCell> cells);

}  // namespace rheocyte
