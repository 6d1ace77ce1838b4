#include "app/shipped_tables.h"

#include <cstdlib>
#include <system_error>

#include "app/build_info.h"
#include "app/child_process.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

fs::path tables_folder() {
  if (const char* given = std::getenv("RHEOCYTE_TABLES")) return given;
  const fs::path installed = program_folder() / "../share/rheocyte/tables";
  std::error_code error;
  return fs::exists(installed, error) ? installed : fs::path(data_folder);
}

}  // namespace

std::map<std::string, fs::path> shipped_tables() {
  std::map<std::string, fs::path> tables;
  std::error_code error;
  constexpr std::string_view prefix = "grid_", suffix = ".cbor";
  for (const auto& entry : fs::directory_iterator(tables_folder(), error)) {
    const std::string name = entry.path().filename().string();
    if (name.size() > prefix.size() + suffix.size() && name.starts_with(prefix) && name.ends_with(suffix))
      tables.emplace(name.substr(prefix.size(), name.size() - prefix.size() - suffix.size()), entry.path());
  }
  return tables;
}

}  // namespace rheocyte
