// Whether files are still those that were read.
#pragma once
#include <filesystem>
#include <span>
#include <string>

namespace rheocyte {

/// A text that becomes another one as soon as a file may hold something else: from its place on the disk, its size, and
/// when its content and its entry were last changed (the former alone can be set back). Of a folder, that of the files
/// in it, without folders. Empty for what is not there. No file is opened.
std::string file_version(const std::filesystem::path& place);

/// The same of several places: the texts of all of them, one after another.
std::string file_version(std::span<const std::filesystem::path> places);

}  // namespace rheocyte
