// Paths as text for JSON, which holds UTF-8 alone; names of files may hold any bytes.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace rheocyte {

/// The path itself if it is UTF-8; a byte that belongs to no character stands as the character U+10FF00 + byte, which
/// no alphabet has.
std::string path_text(const std::filesystem::path&);
/// Back again.
std::filesystem::path path_of_text(std::string_view);

}  // namespace rheocyte
