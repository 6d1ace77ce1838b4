// One text file of a result: whole or not at all, and never in the place of a file that is not ours.
#pragma once
#include <filesystem>
#include <string_view>

namespace rheocyte {

/// Writes `content` beside the wanted place and renames it; makes the parent folders. An existing file is replaced if
/// it begins with `mark`, the words with which all files of this kind from rheocyte begin, or if `force` is given.
/// UserError, and an older file is left as it was.
void write_own_file(const std::filesystem::path&, std::string_view content, std::string_view mark, bool force);

}  // namespace rheocyte
