// A table for one channel, flow rate and viscosity becomes one for others (docs/theory-extract.md, eq:scaling).
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "case/channel_flow.h"
#include "table/table_text.h"

namespace rheocyte {

/// For which a table holds.
ChannelFlow channel_flow_of(const TableText&);

/// Why the scaling is not exact, one phrase each; empty: it is. The fraction of inertia counts from 0.1 % of the
/// deformation on, by an increase of 1.3 % for each unit of the Reynolds number (docs/tables.md).
std::vector<std::string> doubts_of_scaling(const TableText& table, const ChannelFlow& to);

/// The scaled table; header and metadata say from what, and the doubts. Of the metadata every number whose name ends in
/// a unit that scales is scaled.
TableText scaled(const TableText& table, const ChannelFlow& to, std::string_view version);

}  // namespace rheocyte
