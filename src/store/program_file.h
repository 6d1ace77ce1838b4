// Where the running program is.
#pragma once
#include <filesystem>

namespace rheocyte {

/// Links resolved.
std::filesystem::path program_file();

}  // namespace rheocyte
