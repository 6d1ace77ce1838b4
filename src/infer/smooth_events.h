// Areas and deformations of measured events as a table of rheocyte wants them: without what the pixels do, and in the
// channel of the table.
#pragma once
#include <Eigen/Core>

#include "infer/modulus_map.h"
#include "measurement/pixel_errors.h"
#include "numeric/whole_packets.h"

namespace rheocyte {

/// Events that are worked on together: their columns stay in the fastest memory.
inline constexpr std::size_t event_block_size = 512;
using EventColumn = Eigen::Array<double, event_block_size, 1>;

struct SmoothEvents {
  EventColumn log_measured_area;  ///< ln(um^2), as measured
  EventColumn log_area;           ///< ln(um^2) in the channel of the table
  EventColumn deformation;        ///< may be negative
  /// Standard deviations and correlation by pixels; 0 where nothing is corrected.
  EventColumn area_deviation, deformation_deviation, correlation;
};

/// The packet of a column that begins with this event.
inline auto packet_at(EventColumn& column, Eigen::Index first) { return column.segment<packet_size>(first); }
inline auto packet_at(const EventColumn& column, Eigen::Index first) { return column.segment<packet_size>(first); }

/// Of at most event_block_size events (asserted). Areas are corrected only where the conditions want it.
void remove_pixels(const MeasuringConditions& conditions, const ChannelFlow& table, const MeasuredEvents& block,
                   SmoothEvents& smooth);

}  // namespace rheocyte
