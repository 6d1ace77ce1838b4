// The text format of look-up tables and isoelasticity lines that dclab reads (docs/tables.md): all that the program
// knows of it.
#pragma once
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace rheocyte {

/// What the first column holds.
enum class Abscissa { area, volume };

/// Key of the metadata under which the name of a table stands; in files of lines another one, their only difference.
inline constexpr const char *table_identifier_key = "identifier", *lines_identifier_key = "lut identifier";

/// One table or set of lines as it stands in a file.
struct TableText {
  std::vector<std::string> comments;  ///< lines before the metadata, without "# "
  nlohmann::ordered_json metadata;
  Abscissa abscissa = Abscissa::area;
  /// area_um (um^2) or volume (um^3); deform; emodulus (kPa, or mN/m where the metadata say so).
  std::vector<std::array<double, 3>> rows;
};

/// Ten digits, lines end with "\n", ASCII.
std::string to_text(const TableText&);

/// UserError with file and line: no metadata, not JSON, wrong units, other columns, numbers that are none, sizes or
/// moduli that are not positive, no rows.
TableText parse_table_text(std::string_view text, const std::string& name);
TableText read_table_text(const std::filesystem::path& file);

}  // namespace rheocyte
