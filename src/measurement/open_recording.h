// A recording's file, opened, or why it cannot be.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "measurement/hdf5_handle.h"

namespace rheocyte {

struct OpenedRecording {
  Hdf5Handle file = {};
  std::vector<std::filesystem::path> others = {};  ///< files that contain its metadata
  std::vector<std::string> remarks = {};           ///< as of Recording
};

/// For reading. UserError if it is missing, neither an .rtdc file nor a table of events, still being written, or
/// damaged.
OpenedRecording open_recording(const std::filesystem::path& file);

}  // namespace rheocyte
