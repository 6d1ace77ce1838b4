// Where the program stands, and what comes with it.
#pragma once
#include <filesystem>

namespace rheocyte {

/// Where files that come with the program lie: the folder that an environment variable names, or the installed one
/// (`installed` is seen from the folder of the program, or of the library that this code is part of), or that of the
/// sources.
std::filesystem::path supplied_folder(const char* variable, const std::filesystem::path& installed,
                                      const std::filesystem::path& source);

}  // namespace rheocyte
