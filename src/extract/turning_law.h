// How fast the material of a cell beside the axis of a square channel turns, and how fast the cell moves: fits to
// states of the solver for cells off the axis (docs/theory-extract.md, eq:turning-law).
#pragma once
#include "case/channel_flow.h"

namespace rheocyte {

/// Rate (1/s) at which a cell turns, per um that it lies beside the axis: the nose away from the axis. `radius_um` of
/// the cell. Within 8 % of the states of stiff cells with 0.3 to 0.87 of the channel's half width and exponents from
/// 0.6 to 1 of the liquid; soft cells turn faster by up to 10 %. NaN without flow rate, width or radius.
double turning_rate_per_um(double radius_um, const ChannelFlow& flow);

/// Velocity (um/s) of the same cells, within 1 %.
double cell_velocity_um_per_s(double radius_um, const ChannelFlow& flow);

/// By how much (per um beside the axis) a shape that is stored in the cells would tilt on this way, from parallel to
/// the flow: with the rate of a body of this ratio of length to width that lies along the flow (Jeffery 1922).
double tilt_of_stored_shape(double radius_um, double ratio, double way_um, const ChannelFlow& flow);

}  // namespace rheocyte
