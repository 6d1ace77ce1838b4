// Reading files that others have made: never waits for what is not a file (a pipe, a terminal), and never more than is
// wanted.
#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace rheocyte {

/// The first bytes of a regular file, fewer if it is shorter. Nothing if it is none or cannot be read.
std::optional<std::string> first_bytes(const std::filesystem::path&, std::size_t most);

/// All of a regular file. UserError with its path if it is none, cannot be read or holds more.
std::string content_of_file(const std::filesystem::path&, std::size_t most);

}  // namespace rheocyte
