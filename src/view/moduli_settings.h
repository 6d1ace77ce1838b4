// What a page asks of `rheocyte extract`: settings as JSON, and the command that does the same.
#pragma once
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "extract/options.h"

namespace rheocyte {

/// The path of a table that was given to the view, by its item's number. UserError if there is none.
using TableItem = std::function<std::filesystem::path(std::size_t number)>;

/// Settings by the names of the command's options with "_" for "-", without those of files and terminal: {"medium":
/// "CellCarrier", "temperature": 23, "max": ["area_ratio=1.05"], "no_pixelation": true}. The table is the identifier of
/// one that comes with the program, or the number of an item: no path is ever taken. UserError naming the setting.
ExtractOptions extract_options(const nlohmann::ordered_json& settings, const TableItem& table_item);

/// The command with the same settings, for a shell.
std::string extract_command(const ExtractOptions& options, const std::filesystem::path& recording);

/// `rheocyte moduli` with those of them that it has, too, and a combined table.
std::string moduli_command(const ExtractOptions& options, const std::filesystem::path& recording,
                           const std::filesystem::path& table);

/// All settings as JSON, with the table as a path: what is handed to a process of our own, and back.
nlohmann::ordered_json all_settings(const ExtractOptions& options);
ExtractOptions options_of_settings(const nlohmann::ordered_json& settings);

}  // namespace rheocyte
