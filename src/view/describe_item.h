// What the view says of an item before anything is computed.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>

#include "measurement/recording.h"
#include "view/item_places.h"

namespace rheocyte {

/// Of a recording {"events", "conditions", "features", "metadata", "pictures", "remarks", "basins": paths of the
/// files}, of a case and a result {"case"}, of a table {"conditions"}. UserError if it cannot be read.
nlohmann::ordered_json describe_item(const ItemPlace&);

nlohmann::ordered_json paths_json(std::span<const std::filesystem::path> paths);

/// {"channel_width_um", "flow_rate_ul_per_s", "medium", "temperature_C", "pixel_um", "region", "sample", "date",
/// "run"}, as the metadata says; null where it says nothing.
nlohmann::ordered_json stated_conditions(const Metadata&);

}  // namespace rheocyte
