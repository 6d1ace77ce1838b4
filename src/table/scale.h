// A table for one channel, flow rate and viscosity becomes one for others (docs/theory.md, eq:scales).
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "table/table_text.h"

namespace rheocyte {

/// For which a table holds; a shear-thinning liquid has its effective viscosity at the wall.
struct ChannelConditions {
  double channel_width_um = 0, flow_rate_ul_s = 0, viscosity_mPas = 0;
};

ChannelConditions conditions_of(const TableText&);

/// Young's moduli scale by Q' eta' / (Q eta) (W / W')^3, moduli of a cortex by the same with (W / W')^2; areas by
/// (W' / W)^2, volumes by (W' / W)^3; deformations stay.
struct ScaleFactors {
  double modulus = 1, cortex_modulus = 1, area = 1, volume = 1;
};
ScaleFactors scale_factors(const ChannelConditions& from, const ChannelConditions& to);

/// Why the scaling is not exact, one phrase each; empty: it is. The share of inertia counts from 0.1 % of the
/// deformation on, by an increase of 1.3 % for each unit of the Reynolds number (docs/tables.md).
std::vector<std::string> doubts_of_scaling(const TableText& table, const ChannelConditions& to);

/// The scaled table; header and metadata say from what, and the doubts.
TableText scaled(const TableText& table, const ChannelConditions& to, std::string_view version);

}  // namespace rheocyte
