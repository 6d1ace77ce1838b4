// What cells beside the axis of their channel tell: whether their elongation is stored in them or made by the flow, and
// whether they still approach the axis (docs/theory-extract.md, sec. "Cells off the axis").
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <string>

#include "case/channel_flow.h"
#include "numeric/robust_line.h"

namespace rheocyte {

/// Of the events of a recording; spans of one length, NaN where unknown.
struct PlacedOutlines {
  std::span<const double> x_um, y_um, sine_mode_2, flank_slope, area_um2, inertia_ratio;
};

struct BesideAxis {
  std::size_t events = 0;       ///< with a place and an outline
  double spread_um = no_value;  ///< rms of pos_y
  /// Over pos_y, per um; NaN without 15 events and a spread of 0.2 um, as all below.
  Estimate sine_slope = {}, flank_slope = {};
  /// The same of the thirds of the events along the channel, upstream first; NaN without pos_x or a known direction.
  std::array<Estimate, 3> sine_slopes = {}, flank_slopes = {};
  double axis_um = no_value;        ///< pos_y where s_2 is 0, or the median of pos_y if s_2 hardly depends on it
  double way_um = no_value;         ///< between the middles of the first and the last third
  double inertia_ratio = no_value;  ///< median
  Estimate centring = {};           ///< relative change of the rms of pos_y per um downstream
  /// What a stored shape would have turned by on that way (per um of pos_y); NaN without a flow rate.
  double stored_slope = no_value;

  /// Of the slope of the flanks, from the first to the last third.
  Estimate flank_change() const;
  /// Whether the elongation is stored in the cells; unknown as well where they are not elongated.
  enum class Turn { unknown, parallel, stored, towards_axis, undecided };
  Turn turn() const;
  /// Whether the spread of pos_y falls downstream by more than chance.
  bool is_centring() const;
  /// In one sentence each; empty where nothing is known.
  std::string turn_text() const;
  std::string centring_text() const;
};

/// `direction`: in which the cells move along x, +1 or -1; 0: unknown. Robust lines throughout.
BesideAxis beside_axis(const PlacedOutlines& outlines, int direction, const ChannelFlow& flow);

}  // namespace rheocyte
