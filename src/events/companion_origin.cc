#include "events/companion_origin.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <optional>
#include <system_error>
#include <utility>

#include "case/refuse_path.h"
#include "case/user_error.h"
#include "measurement/basin.h"
#include "measurement/text_table.h"
#include "store/build_info.h"
#include "store/isolated.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

std::string now_utc() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

// Paths under which the original is looked for: where it is now, seen from the companion's folder, and in that folder.
std::vector<std::string> paths_to(const fs::path& original, const fs::path& folder) {
  std::error_code error;
  const fs::path absolute = fs::weakly_canonical(fs::absolute(original), error);
  const fs::path relative = fs::relative(absolute, folder, error);
  std::vector<std::string> paths{absolute.string()};
  for (const auto& path : {relative.string(), original.filename().string()})
    if (!path.empty() && std::ranges::find(paths, path) == paths.end()) paths.push_back(path);
  return paths;
}

std::string log_of(const std::string& command) { return "rheocyte-" + command; }

[[noreturn]] void refuse_to_replace(const fs::path& place, const std::string& what) {
  refuse_path(place, fmt::format("already exists and {}; move it away, or name another folder with -o.", what));
}

// Nothing if it is not a recording at all.
std::optional<Metadata> metadata_in(const fs::path& place) {
  try {
    return Recording(place).metadata();
  } catch (const UserError&) {
    return std::nullopt;
  }
}

/// Whether a file is a recording with the log of a companion of this command. Nothing once the user wants to stop.
std::optional<bool> look_for_log(const std::string& command, const fs::path& file) {
  const auto has_our_log = [&](const TellProgress&) {
    try {
      return has_log(Recording(file), log_of(command));
    } catch (const UserError&) {  // no recording at all
      return false;
    }
  };
  const auto looked = run_isolated(has_our_log);
  if (looked.stopped()) return {};
  if (looked.end.kind == IsolatedEnd::Kind::user_error) throw UserError(looked.end.text);
  return looked.finished() && looked.result;
}

}  // namespace

std::string program() { return fmt::format("rheocyte {}", version); }

std::vector<std::string> free_features(const Recording& recording) {
  std::vector<std::string> names;
  for (int k = 0; k < 10; ++k)
    if (auto name = fmt::format("userdef{}", k); !recording.has_scalar(name)) names.push_back(std::move(name));
  return names;
}

void describe_feature(CompanionFile& companion, const std::string& feature, const std::string& role,
                      const std::string& meaning) {
  companion.add_user_metadata("rheocyte " + feature, meaning);
  companion.add_user_metadata("rheocyte " + role, feature);
}

void add_origin(CompanionFile& companion, const std::string& command, const Recording& recording,
                const fs::path& folder, const std::vector<std::string>& lines) {
  std::vector<std::string> log{fmt::format("{} {}", program(), command), "time: " + now_utc(),
                               "recording: " + recording.file().filename().string()};
  log.insert(log.end(), lines.begin(), lines.end());
  companion.add_log(log_of(command), log);
  if (!is_text_table(recording.file())) companion.add_basin(paths_to(recording.file(), folder));
}

bool is_companion_of(const std::string& command, const fs::path& file) {
  return look_for_log(command, file).value_or(false);
}

void check_companion(const std::string& command, const fs::path& place) {
  std::error_code error;
  if (fs::exists(place, error) && !look_for_log(command, place).value_or(true))
    refuse_to_replace(place, "was not written by rheocyte " + command);
}

void check_same_recording(const fs::path& place, const Recording& original) {
  const auto metadata = metadata_in(place);
  if (metadata && !same_measurement(original.metadata(), *metadata, false))
    refuse_to_replace(place, "belongs to another recording of this name");
}

}  // namespace rheocyte
