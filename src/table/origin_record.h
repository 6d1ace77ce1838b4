// The origin of a table in the records of what was made of it.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "table/table_origin.h"
#include "table/table_spec.h"

namespace rheocyte {

/// Of a table with this spec, computed by this version of the program.
TableOrigin origin_of(const TableSpec& spec, std::string_view version);

/// Adds its keys to a record.
void put_origin(const TableOrigin& origin, nlohmann::json& record);
/// Back; DamagedRecord, or an exception of the reader.
TableOrigin origin_from(const nlohmann::json& record);

/// A number above 0; DamagedRecord if it is none.
double positive_number(const nlohmann::json& record, const char* key);

/// Of such a record, from its first bytes (keys stand in the order of their letters, long columns behind these);
/// nothing if that is none.
std::optional<GridHead> grid_head(std::string_view head);
inline constexpr std::size_t grid_head_bytes = 4096;

}  // namespace rheocyte
