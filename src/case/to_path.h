// Paths from texts. All texts of the program are UTF-8; what std::filesystem::path makes of a narrow text by itself is
// another thing on Windows, and each standard library has its own.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace rheocyte {

/// The path that a text in UTF-8 names; where paths are bytes, any bytes. A path from a literal in ASCII needs no
/// conversion; tools/tidy finds all others.
inline std::filesystem::path to_path(std::string_view utf8) { return std::u8string(utf8.begin(), utf8.end()); }

}  // namespace rheocyte
