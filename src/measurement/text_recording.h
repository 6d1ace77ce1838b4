// A table of events as text, opened as if it were a recording's file.
#pragma once
#include <filesystem>

#include "measurement/open_recording.h"

namespace rheocyte {

/// The columns of the table are the features of an HDF5 file in memory, its comments and a TOML file of the same name
/// in its folder the metadata. UserError.
OpenedRecording open_text_recording(const std::filesystem::path& file);

}  // namespace rheocyte
