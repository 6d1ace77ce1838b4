// What a page asks of `rheocyte extract`: settings as JSON, and the commands that do the same.
#pragma once
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "events/options.h"

namespace rheocyte {

/// The path of a table that was given to the view, by its item's number. UserError if there is none.
using TableItem = std::function<std::filesystem::path(std::size_t number)>;

/// Of settings as GET /api/settings declares them (report/settings_text.h). The table is the identifier of one that
/// comes with the program, or the number of an item, and polygons are features and corners: no path is ever taken.
/// UserError naming the setting.
ExtractOptions extract_options(const nlohmann::ordered_json& settings, const TableItem& table_item);

/// UserError: polygons of a request are features and corners.
void refuse_polygon_files(const nlohmann::ordered_json& settings);

/// With those of them that `rheocyte moduli` has, too, and a combined table.
ModuliOptions moduli_options(const ExtractOptions& options, const std::filesystem::path& table);

/// The command with the same settings, for a shell.
std::string extract_command(ExtractOptions options, const std::filesystem::path& recording);
std::string moduli_command(ModuliOptions options, const std::filesystem::path& recording);

/// All settings as JSON, with the table as a path: what is handed to a process of our own, and back.
nlohmann::ordered_json all_settings(ExtractOptions options);
ExtractOptions options_of_settings(const nlohmann::ordered_json& settings);

}  // namespace rheocyte
