// Which recordings a command works on, and where the results of each go.
#pragma once
#include <vector>

#include "extract/extract_recording.h"
#include "extract/options.h"

namespace rheocyte {

struct RecordingTask {
  std::filesystem::path recording;
  ExtractOutput output;
};

/// The given files, and those in the given folders whose names end in .rtdc and not in what this program appends; in
/// the order given, folders sorted by name. Results go beside each recording, or below the output folder with the
/// sub-folders kept. UserError: a folder without -r, no recordings, two recordings with one name for their results.
std::vector<RecordingTask> list_recordings(const BatchOptions& options);

/// Where the table of all recordings goes.
std::filesystem::path summary_file(const BatchOptions& options, const std::vector<RecordingTask>& tasks);

}  // namespace rheocyte
