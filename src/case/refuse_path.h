// What is said of a file or folder that cannot be used.
#pragma once
#include <filesystem>
#include <string_view>

namespace rheocyte {

/// UserError "PATH: REASON", the path as one_line(); the reason ends in a full stop.
[[noreturn]] void refuse_path(const std::filesystem::path& path, std::string_view reason);

/// A recording that is not there; an address on a network is no file.
[[noreturn]] void refuse_missing(const std::filesystem::path& recording);

}  // namespace rheocyte
