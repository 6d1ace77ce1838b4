#include "extract/recording_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <system_error>

#include "case/user_error.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view suffix = "_rheocyte";

bool is_companion(const fs::path& file) { return file.stem().string().ends_with(suffix); }

/// A recording and its folder as seen from the folder that the user gave.
struct Found {
  fs::path recording, below;
};

void search(const fs::path& folder, std::vector<Found>& found) {
  std::vector<fs::path> files;
  std::error_code error;
  constexpr auto quiet = fs::directory_options::skip_permission_denied;
  for (auto at = fs::recursive_directory_iterator(folder, quiet, error); !error && at != fs::end(at);
       at.increment(error))
    if (at->path().extension() == ".rtdc" && at->is_regular_file(error) && !is_companion(at->path()))
      files.push_back(at->path());
  if (error)
    throw UserError(fmt::format("{}: cannot be searched ({}).", one_line(folder.string(), 300), error.message()));
  std::ranges::sort(files);
  for (const auto& file : files) found.push_back({file, fs::relative(file.parent_path(), folder, error)});
}

}  // namespace

std::vector<RecordingTask> list_recordings(const BatchOptions& options) {
  std::vector<Found> found;
  for (const auto& input : options.inputs) {
    std::error_code error;
    if (!fs::is_directory(input, error))
      found.push_back({input, {}});
    else if (options.recursive)
      search(input, found);
    else
      throw UserError(
          fmt::format("{}: is a folder; give -r to search it for recordings.", one_line(input.string(), 300)));
  }
  if (found.empty()) throw UserError("rheocyte: there is no recording (.rtdc) in the given folders.");
  std::vector<RecordingTask> tasks;
  std::map<fs::path, fs::path> taken;
  for (const auto& [recording, below] : found) {
    const fs::path folder = options.folder.empty() ? recording.parent_path() : options.folder / below;
    const fs::path base = (folder / recording.stem()).lexically_normal().string() + std::string(suffix);
    tasks.push_back({recording, {base.string() + ".rtdc", base.string() + ".tsv"}});
    const auto [other, is_new] = taken.try_emplace(fs::absolute(base).lexically_normal(), recording);
    if (!is_new)
      throw UserError(
          fmt::format("{} and {} would have results of one name; give them in two calls with different "
                      "folders.",
                      one_line(other->second.string(), 300), one_line(recording.string(), 300)));
  }
  return tasks;
}

fs::path summary_file(const BatchOptions& options, const std::vector<RecordingTask>& tasks) {
  const fs::path folder = options.folder.empty() ? tasks.front().output.events.parent_path() : options.folder;
  return folder / "rheocyte_summary.tsv";
}

}  // namespace rheocyte
