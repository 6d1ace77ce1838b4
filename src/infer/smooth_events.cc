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
  smooth.log_measured_area.head(rows) = 1;
  smooth.deformation.head(rows) = 0;
  std::ranges::copy(block.size, smooth.log_measured_area.data());
  std::ranges::copy(block.deformation, smooth.deformation.data());
  for (EventColumn* column : {&smooth.log_measured_area, &smooth.deformation})
    column->head(rows) += column->head(rows) - column->head(rows);  // infinity is not a number either
  smooth.log_measured_area.head(rows) = smooth.log_measured_area.head(rows).log();
  smooth.log_area.head(rows) =
      smooth.log_measured_area.head(rows) + std::log(scale_factors(conditions.flow, table).area);
  for (EventColumn* column : {&smooth.area_deviation, &smooth.deformation_deviation, &smooth.correlation})
    column->head(rows) = 0;
  if (!(conditions.pixel_size_um > 0)) return;
  const double log_pixel_area = 2 * std::log(conditions.pixel_size_um);
  for (Eigen::Index k = 0; k < rows; k += packet_size) {
    const Packet log_area_px = packet_at(smooth.log_measured_area, k) - log_pixel_area,
                 deformation = packet_at(smooth.deformation, k);
    const auto pixels = pixel_errors(log_area_px, deformation);
    packet_at(smooth.deformation, k) -= pixels.deformation_excess;
    if (conditions.correct_area) packet_at(smooth.log_area, k) += pixels.area_factor.log();
    packet_at(smooth.area_deviation, k) = pixels.area_deviation;
    packet_at(smooth.deformation_deviation, k) = pixels.deformation_deviation;
    packet_at(smooth.correlation, k) = pixels.correlation;
  }
}

}  // namespace rheocyte
