// The tables that lie in a folder as one file each.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace rheocyte {

/// Files <kind>_<identifier>.cbor by identifier; none where there is no such folder.
std::map<std::string, std::filesystem::path> table_files(const std::filesystem::path& folder, std::string_view kind);

}  // namespace rheocyte
