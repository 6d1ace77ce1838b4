#include "infer/smooth_events.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rheocyte {

// One packet after the other, whatever the number of events: the results of one do not depend on it.
template <std::size_t most>
void remove_pixels(const MeasuringConditions& conditions, const MeasuredEvents& block, SmoothEventsOf<most>& smooth) {
  const std::size_t count = block.size.size();
  assert(count <= most && block.deformation.size() == count);
  const Eigen::Index rows = std::min(whole_packets(count), Eigen::Index(most));
  const bool has_pixels = conditions.pixel_size_um > 0;
  const double log_pixel_area = has_pixels ? 2 * std::log(conditions.pixel_size_um) : 0;
  for (Eigen::Index k = Eigen::Index(count) / packet_size * packet_size; k < rows; k += packet_size) {
    packet_at(smooth.log_measured_area, k) = 1;
    packet_at(smooth.deformation, k) = 0;
  }
  std::ranges::copy(block.size, smooth.log_measured_area.data());
  std::ranges::copy(block.deformation, smooth.deformation.data());
  for (Eigen::Index k = 0; k < rows; k += packet_size) {
    Packet area = packet_at(smooth.log_measured_area, k), deformation = packet_at(smooth.deformation, k);
    for (Packet* packet : {&area, &deformation}) *packet += *packet - *packet;  // infinity is not a number either
    const Packet log_measured = area.log();
    packet_at(smooth.log_measured_area, k) = log_measured;
    Packet log_area_factor = Packet::Zero();
    PixelErrorsOf<Packet> pixels{Packet::Ones(), Packet::Zero(), Packet::Zero(), Packet::Zero(), Packet::Zero()};
    if (has_pixels) {
      pixels = pixel_errors<Packet>(log_measured - log_pixel_area, deformation);
      deformation -= pixels.deformation_excess;
      if (conditions.correct_area) log_area_factor = pixels.area_factor.log();
    }
    packet_at(smooth.log_area_factor, k) = log_area_factor;
    packet_at(smooth.deformation, k) = deformation;
    packet_at(smooth.area_deviation, k) = pixels.area_deviation;
    packet_at(smooth.deformation_deviation, k) = pixels.deformation_deviation;
    packet_at(smooth.correlation, k) = pixels.correlation;
  }
}

template void remove_pixels(const MeasuringConditions&, const MeasuredEvents&, SmoothEventsOf<event_block_size>&);
template void remove_pixels(const MeasuringConditions&, const MeasuredEvents&, SmoothEventsOf<few_events>&);

}  // namespace rheocyte
