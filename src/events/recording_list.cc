#include "events/recording_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <system_error>

#include "case/refuse_path.h"
#include "case/to_path.h"
#include "case/user_error.h"
#include "measurement/text_table.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

/// Or a table of events beside one.
bool is_companion(const fs::path& file) {
  return (file.extension() == ".rtdc" || is_text_table(file)) && file.stem().string().ends_with(companion_suffix);
}

fs::path full_folder(const fs::path& folder) {
  std::error_code error;
  const fs::path absolute = fs::absolute(folder.empty() ? "." : folder).lexically_normal(),
                 full = fs::weakly_canonical(absolute, error);
  return error ? absolute : full;
}

// A link to a file stays what the user calls it.
fs::path in_full(const fs::path& file) { return full_folder(file.parent_path()) / file.filename(); }

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
  if (error) refuse_path(folder, fmt::format("cannot be searched ({}).", error.message()));
  std::ranges::sort(files);
  for (const auto& file : files) found.push_back({file, fs::relative(file.parent_path(), folder, error)});
}

std::vector<Found> found_by(const BatchOptions& options, std::vector<fs::path>& passed_over) {
  std::vector<Found> found;
  for (const auto& input : options.inputs) {
    std::error_code error;
    if (!fs::is_directory(input, error) && is_companion(input))
      passed_over.push_back(input);
    else if (!fs::is_directory(input, error))
      found.push_back({input, {}});
    else if (options.recursive)
      search(input, found);
    else
      refuse_path(input, "is a folder; give -r to search it for recordings.");
  }
  std::set<fs::path> seen;
  std::erase_if(found, [&](const Found& one) { return !seen.insert(in_full(one.recording)).second; });
  return found;
}

fs::path results_of(const Found& found, const BatchOptions& options, const std::string& before_name) {
  const fs::path folder = options.folder.empty() ? found.recording.parent_path() : options.folder / found.below;
  return (folder / to_path(before_name + found.recording.stem().string())).lexically_normal();
}

std::string name_of_folder(const fs::path& recording) { return in_full(recording).parent_path().filename().string(); }

fs::path place_of_input(const fs::path& input) {
  std::error_code error;
  return fs::is_directory(input, error) ? full_folder(input) : in_full(input).parent_path();
}

// By full place, the recordings whose results would go there.
using Places = std::map<fs::path, std::vector<const Found*>>;

void check_for_one_name(const Places& places) {
  for (const auto& [place, recordings] : places)
    if (recordings.size() > 1)
      throw UserError(fmt::format(
          "the results of {} and {} would have the same name; give them in two calls with different folders.",
          one_line(recordings[0]->recording.string(), 300), one_line(recordings[1]->recording.string(), 300)));
}

}  // namespace

RecordingList list_recordings(const BatchOptions& options) {
  RecordingList list;
  const std::vector<Found> found = found_by(options, list.passed_over);
  if (found.empty() && !list.passed_over.empty())
    refuse_path(list.passed_over.front(),
                "is a result of this program, according to its name; give the original recording.");
  if (found.empty()) throw UserError("rheocyte: there is no recording (.rtdc) in the given folders.");
  Places plain, used;
  for (const auto& one : found) plain[in_full(results_of(one, options, ""))].push_back(&one);
  for (const auto& one : found) {
    const bool is_alone = plain[in_full(results_of(one, options, ""))].size() == 1;
    const fs::path results = results_of(one, options, is_alone ? "" : name_of_folder(one.recording) + "_");
    used[in_full(results)].push_back(&one);
    list.tasks.push_back({one.recording, results});
  }
  check_for_one_name(used);
  return list;
}

std::vector<fs::path> without_companions_of_others(const std::vector<fs::path>& files) {
  std::set<fs::path> given;  // without their endings
  for (const auto& file : files) given.insert(in_full(file).replace_extension());
  std::vector<fs::path> kept;
  std::ranges::copy_if(files, std::back_inserter(kept), [&](const fs::path& file) {
    const std::string stem = file.stem().string();
    return !is_companion(file) ||
           !given.contains(
               in_full(file.parent_path() / to_path(stem.substr(0, stem.size() - companion_suffix.size()))));
  });
  return kept;
}

std::string passed_over_text(const std::vector<fs::path>& passed_over) {
  const std::string first = one_line(passed_over.front().string(), 300);
  if (passed_over.size() == 1) return fmt::format("{}: is a result of this program and was skipped.", first);
  return fmt::format("{} and {} more are results of this program and were skipped.", first, passed_over.size() - 1);
}

fs::path summary_file(const BatchOptions& options) {
  constexpr const char* name = "rheocyte_summary.tsv";
  if (!options.folder.empty()) return options.folder / name;
  fs::path common = place_of_input(options.inputs.front());
  for (const auto& input : options.inputs) {
    const fs::path place = place_of_input(input);
    while (std::ranges::mismatch(common, place).in1 != common.end()) common = common.parent_path();
  }
  // No one's results belong at the root of the file system.
  return (common == common.root_path() ? place_of_input(options.inputs.front()) : common) / name;
}

}  // namespace rheocyte
