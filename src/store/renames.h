// Two names of files or folders that change at once, whatever other programs do meanwhile.
#pragma once
#include <filesystem>

namespace rheocyte {

/// Both return 0, or the number of the error: EINVAL where the file system knows no such thing.
/// EEXIST if something stands there already.
int rename_to_new(const std::filesystem::path& from, const std::filesystem::path& to);
int exchange_names(const std::filesystem::path& one, const std::filesystem::path& other);

}  // namespace rheocyte
