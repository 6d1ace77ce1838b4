#include "view/moduli_settings.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "case/to_path.h"
#include "case/user_error.h"
#include "events/polygon_file.h"
#include "events/recording_settings.h"
#include "report/settings_text.h"
#include "shelf/shipped_tables.h"
#include "view/path_text.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;

std::string named_table(const Json& table, const TableItem& table_item) {
  if (table.is_number_integer() && table >= 0) return path_text(table_item(table.get<std::size_t>()));
  const auto shipped = shipped_tables();
  std::string names;
  for (const auto& [identifier, file] : shipped) names += (names.empty() ? "" : ", ") + identifier;
  if (table.is_string()) {
    auto identifier = table.get<std::string>();
    if (identifier.empty() || shipped.contains(identifier)) return identifier;
  }
  throw UserError(fmt::format(
      "The setting table is the identifier of a table of the program ({}), or the number of an item.", names));
}

}  // namespace

ExtractOptions options_of_settings(const Json& settings) {
  ExtractOptions options;
  take_settings(settings_of(options), settings);
  options.table = path_of_text(options.table).string();
  check_options(options);
  return options;
}

void refuse_polygon_files(const Json& settings) {
  for (const Json& one : settings.value("polygon", Json::array()))
    if (one.is_string() && is_polygon_file(one)) throw UserError("polygon must be features and corners, not a file.");
}

ExtractOptions extract_options(const Json& settings, const TableItem& table_item) {
  if (!settings.is_object()) return options_of_settings(settings);
  refuse_polygon_files(settings);
  Json resolved = settings;
  if (settings.contains("table") && !settings["table"].is_null())
    resolved["table"] = named_table(settings["table"], table_item);
  const auto table = resolved.find("table");
  if (table != resolved.end() && table->is_string() && table->get_ref<const std::string&>().empty())
    resolved.erase(table);  // that of the medium
  return options_of_settings(resolved);
}

ModuliOptions moduli_options(const ExtractOptions& options, const std::filesystem::path& table) {
  ModuliOptions wanted;
  wanted.measuring = options.measuring;
  wanted.table = table;
  return wanted;
}

Json all_settings(ExtractOptions options) {
  options.table = path_text(to_path(options.table));
  return given_settings(settings_of(options));
}

std::string extract_command(ExtractOptions options, const std::filesystem::path& recording) {
  return "rheocyte extract " + quoted_for_shell(recording.string()) + options_text(settings_of(options));
}

std::string moduli_command(ModuliOptions options, const std::filesystem::path& recording) {
  return fmt::format("rheocyte moduli {} --table {}{}", quoted_for_shell(recording.string()),
                     quoted_for_shell(options.table.string()), options_text(settings_of(options)));
}

}  // namespace rheocyte
