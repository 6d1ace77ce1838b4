#include "table/table_files.h"

#include <fmt/format.h>

#include <system_error>

namespace rheocyte {

std::map<std::string, std::filesystem::path> table_files(const std::filesystem::path& folder, std::string_view kind) {
  std::map<std::string, std::filesystem::path> files;
  const std::string before = fmt::format("{}_", kind);
  constexpr std::string_view behind = ".cbor";
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.size() > before.size() + behind.size() && name.starts_with(before) && name.ends_with(behind))
      files.emplace(name.substr(before.size(), name.size() - before.size() - behind.size()), entry.path());
  }
  return files;
}

}  // namespace rheocyte
