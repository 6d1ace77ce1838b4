#include "extract/companion_origin.h"

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

[[noreturn]] void refuse_to_replace(const fs::path& place, const char* what) {
  refuse_path(place, fmt::format("is there and {}; move it away, or name another folder with -o.", what));
}

// Nothing if it is not a recording at all.
std::optional<Metadata> metadata_in(const fs::path& place) {
  try {
    return Recording(place).metadata();
  } catch (const UserError&) {
    return std::nullopt;
  }
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
  companion.add_log("rheocyte-" + command, log);
  companion.add_basin(paths_to(recording.file(), folder));
}

void check_companion(const fs::path& place) {
  std::error_code error;
  if (!fs::exists(place, error)) return;
  // Our own say in their metadata which program has written them.
  const auto is_ours = [&](const TellProgress&) {
    const auto metadata = metadata_in(place);
    const auto programs = metadata ? metadata->text("setup:software version") : std::nullopt;
    return programs && programs->find("rheocyte ") != std::string::npos;
  };
  const auto looked = run_isolated(is_ours, {}, [](double) {});
  if (looked.end.kind == IsolatedEnd::Kind::user_error) throw UserError(looked.end.text);
  if (!looked.stopped() && !(looked.finished() && looked.result))
    refuse_to_replace(place, "was not written by rheocyte");
}

void check_same_recording(const fs::path& place, const Recording& original) {
  const auto metadata = metadata_in(place);
  if (metadata && !same_measurement(original.metadata(), *metadata, false))
    refuse_to_replace(place, "belongs to another recording of this name");
}

}  // namespace rheocyte
