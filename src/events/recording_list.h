// Which recordings a command works on, and where the results of each go.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "case/to_path.h"
#include "events/options.h"

namespace rheocyte {

struct RecordingTask {
  std::filesystem::path recording;
  std::filesystem::path results;  ///< folder and name of its results, to which each file adds an ending

  /// With an ending such as "_rheocyte.rtdc".
  std::filesystem::path result(const std::string& ending) const { return to_path(results.string() + ending); }
};

struct RecordingList {
  std::vector<RecordingTask> tasks;
  std::vector<std::filesystem::path> passed_over;  ///< results of this program among the given files
};

/// What the names of companions end with, before ".rtdc".
inline constexpr std::string_view companion_suffix = "_rheocyte";

/// The given files, and those in the given folders whose names end in .rtdc, each once and without companions; in the
/// order given, folders sorted by name. Results go beside each recording, or below the output folder with the
/// sub-folders kept; the names of recordings that would be alike there begin with the name of their folder. UserError:
/// a folder without -r, no recordings, two recordings with one name for their results all the same.
RecordingList list_recordings(const BatchOptions& options);

/// The same files without the companions of others of them.
std::vector<std::filesystem::path> without_companions_of_others(const std::vector<std::filesystem::path>& files);

/// The sentence about results among the given files.
std::string passed_over_text(const std::vector<std::filesystem::path>& passed_over);

/// Where the table of all recordings goes: the output folder, or that in which all given files and folders lie.
std::filesystem::path summary_file(const BatchOptions& options);

}  // namespace rheocyte
