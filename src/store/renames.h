// Two names of files or folders that change at once, whatever other programs do meanwhile.
#pragma once
#include <filesystem>

namespace rheocyte {

/// All return 0, or the number of the error (errno); the first two EINVAL where the file system knows no such thing.
int exchange_names(const std::filesystem::path& one, const std::filesystem::path& other);
/// EEXIST if something stands there already.
int rename_to_new(const std::filesystem::path& from, const std::filesystem::path& to);
/// Replaces a file that stands there.
int rename_over(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace rheocyte
