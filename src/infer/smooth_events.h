// Areas and deformations of measured events as a table of rheocyte wants them: without what the pixels do, and in the
// channel of the table.
#pragma once
#include <Eigen/Core>
#include <cmath>

#include "infer/modulus_map.h"
#include "measurement/pixel_errors.h"
#include "numeric/whole_packets.h"

namespace rheocyte {

/// Events that are worked on together: their columns stay in the fastest memory.
inline constexpr std::size_t event_block_size = 512;
/// Or so few, which a whole block would slow down; with the same results.
inline constexpr std::size_t few_events = packet_size;

template <std::size_t most>
struct SmoothEventsOf {
  using Column = Eigen::Array<double, most, 1>;
  Column log_measured_area;  ///< ln(um^2), as measured
  Column log_area_factor;    ///< by which pixels change it
  Column log_area;           ///< ln(um^2) in the channel of the table
  Column deformation;        ///< may be negative
  /// Standard deviations and correlation by pixels; 0 where nothing is corrected.
  Column area_deviation, deformation_deviation, correlation;
};
struct SmoothEvents : SmoothEventsOf<event_block_size> {};

/// The packet of a column that begins with this event.
template <class Column>
auto packet_at(Column& column, Eigen::Index first) {
  return column.template segment<packet_size>(first);
}

/// All but the area in the channel of a table. Of at most so many events (asserted): event_block_size or few_events.
/// Areas are corrected only where the conditions want it.
template <std::size_t most>
void remove_pixels(const MeasuringConditions& conditions, const MeasuredEvents& block, SmoothEventsOf<most>& smooth);

/// The areas of the first events in the channel of a table.
template <std::size_t most>
void scale_areas(const MeasuringConditions& conditions, const ChannelFlow& table, std::size_t count,
                 SmoothEventsOf<most>& smooth) {
  const double log_factor = std::log(scale_factors(conditions.flow, table).area);
  for (Eigen::Index k = 0; k < Eigen::Index(count); k += packet_size)
    packet_at(smooth.log_area, k) =
        packet_at(smooth.log_measured_area, k) + log_factor + packet_at(smooth.log_area_factor, k);
}

/// Both.
template <std::size_t most>
void remove_pixels(const MeasuringConditions& conditions, const ChannelFlow& table, const MeasuredEvents& block,
                   SmoothEventsOf<most>& smooth) {
  remove_pixels(conditions, block, smooth);
  scale_areas(conditions, table, block.size.size(), smooth);
}

}  // namespace rheocyte
