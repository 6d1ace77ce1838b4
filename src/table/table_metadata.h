// Facts that stand in the headers of all files of a table.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "table/table_spec.h"

namespace rheocyte {

/// Files in the text formats of rheocyte's tables begin so.
inline constexpr std::string_view table_mark = "# rheocyte ";

/// For example "neo-hookean solid / newtonian fluid".
std::string model_text(const Case&);

/// Metadata in dclab's terms and all parameters of the case, which stand below "case" without radius and stiffness.
/// `program`: that computed the table, with its version.
nlohmann::ordered_json table_metadata(const TableSpec&, std::string_view program);

/// "kPa" or "mN/m", and the column of tables: "young_modulus_kPa" or "cortex_modulus_mN_per_m".
std::string_view stiffness_unit(const TableSpec&);
std::string_view stiffness_column(const TableSpec&);

}  // namespace rheocyte
