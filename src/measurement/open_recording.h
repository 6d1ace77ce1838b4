// A recording's file, opened, or why it cannot be.
#pragma once
#include <filesystem>

#include "measurement/hdf5_handle.h"

namespace rheocyte {

/// For reading. UserError if it is missing, no .rtdc file, still being written, or damaged.
Hdf5Handle open_recording(const std::filesystem::path& file);

}  // namespace rheocyte
