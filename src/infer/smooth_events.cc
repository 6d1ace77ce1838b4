#include "infer/smooth_events.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rheocyte {

void remove_pixels(const MeasuringConditions& conditions, const ChannelFlow& table, const MeasuredEvents& block,
                   SmoothEvents& smooth) {
  const std::size_t count = block.size.size();
  assert(count <= event_block_size && block.deformation.size() == count);
  const Eigen::Index rows = whole_packets(count);
  smooth.log_area.head(rows) = 1;
  std::ranges::copy(block.size, smooth.log_area.data());
  smooth.log_area.head(rows) = smooth.log_area.head(rows).log();
  std::ranges::copy(block.deformation, smooth.deformation.data());
  std::ranges::fill(smooth.pixels, PixelErrors{});
  if (conditions.pixel_size_um > 0) {
    const double log_pixel_area = 2 * std::log(conditions.pixel_size_um);
    EventColumn factor = EventColumn::Ones();
    for (std::size_t i = 0; i < count; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      smooth.pixels[i] = pixel_errors(smooth.log_area[k] - log_pixel_area, smooth.deformation[k]);
      smooth.deformation[k] -= smooth.pixels[i].deformation_excess;
      factor[k] = smooth.pixels[i].area_factor;
    }
    if (conditions.correct_area) smooth.log_area.head(rows) += factor.head(rows).log();
  }
  smooth.log_area.head(rows) += std::log(scale_factors(conditions.flow, table).area);
}

}  // namespace rheocyte
