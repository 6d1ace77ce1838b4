// A file that is written whole or not at all.
#pragma once
#include <filesystem>
#include <string_view>

namespace rheocyte {

/// Writes `content` to `scratch`, which must lie on the same file system, brings it to the disk and renames it to
/// `path`. Returns 0 or the number of the error (errno); then there is no scratch, unless it was there before
/// (EEXIST), and an older file is left as it was.
int write_whole_file(const std::filesystem::path& scratch, const std::filesystem::path& path, std::string_view content);

}  // namespace rheocyte
