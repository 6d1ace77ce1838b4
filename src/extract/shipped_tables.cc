#include "extract/shipped_tables.h"

#include <fmt/format.h>

#include <system_error>

#include "case/user_error.h"
#include "store/build_info.h"
#include "store/supplied_folder.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

fs::path tables_folder() { return supplied_folder("RHEOCYTE_TABLES", "../share/rheocyte/tables", data_folder); }

std::map<std::string, fs::path> files_with(std::string_view prefix) {
  std::map<std::string, fs::path> tables;
  std::error_code error;
  constexpr std::string_view suffix = ".cbor";
  for (const auto& entry : fs::directory_iterator(tables_folder(), error)) {
    const std::string name = entry.path().filename().string();
    if (name.size() > prefix.size() + suffix.size() && name.starts_with(prefix) && name.ends_with(suffix))
      tables.emplace(name.substr(prefix.size(), name.size() - prefix.size() - suffix.size()), entry.path());
  }
  return tables;
}

fs::path wanted_or_shipped(const fs::path& wanted, std::string_view prefix, std::string_view noun) {
  std::error_code error;
  if (!wanted.empty() && fs::exists(wanted, error)) return wanted;
  const auto shipped = files_with(prefix);
  if (wanted.empty() && shipped.empty())
    throw UserError(fmt::format(
        "rheocyte: the {} that comes with the program is missing in {}; install the program again, or give --table.",
        noun, tables_folder().string()));
  const auto found = wanted.empty() ? shipped.begin() : shipped.find(wanted.string());
  return found == shipped.end() ? wanted : found->second;
}

}  // namespace

std::map<std::string, fs::path> shipped_tables() { return files_with("grid_"); }

std::map<std::string, fs::path> shipped_elongated_tables() { return files_with("elongated_"); }

fs::path combined_table_or_shipped(const fs::path& wanted) {
  return wanted_or_shipped(wanted, "combined_", "combined table");
}

fs::path dynamic_table_or_shipped(const fs::path& wanted) {
  return wanted_or_shipped(wanted, "dynamic_", "dynamic table");
}

}  // namespace rheocyte
