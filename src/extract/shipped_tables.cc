#include "extract/shipped_tables.h"

#include <system_error>

#include "store/build_info.h"
#include "store/supplied_folder.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

std::map<std::string, fs::path> files_with(std::string_view prefix) {
  std::map<std::string, fs::path> tables;
  std::error_code error;
  const fs::path folder = supplied_folder("RHEOCYTE_TABLES", "../share/rheocyte/tables", data_folder);
  constexpr std::string_view suffix = ".cbor";
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.size() > prefix.size() + suffix.size() && name.starts_with(prefix) && name.ends_with(suffix))
      tables.emplace(name.substr(prefix.size(), name.size() - prefix.size() - suffix.size()), entry.path());
  }
  return tables;
}

}  // namespace

std::map<std::string, fs::path> shipped_tables() { return files_with("grid_"); }

std::map<std::string, fs::path> shipped_elongated_tables() { return files_with("elongated_"); }

}  // namespace rheocyte
