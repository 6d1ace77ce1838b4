#include "app/recording_batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "case/refuse_path.h"
#include "store/process_limits.h"

namespace rheocyte {

namespace fs = std::filesystem;

ResultFolderGuard::ResultFolderGuard(const fs::path& folder, const fs::path& of_all) {
  std::error_code error;
  std::vector<fs::path> missing;
  const fs::path top = (of_all / "result").lexically_normal().parent_path();
  for (fs::path at = folder; !at.empty() && at != top && !fs::exists(at, error); at = at.parent_path())
    missing.push_back(at);
  if (!folder.empty() && !fs::is_directory(folder, error)) fs::create_directories(folder, error);
  if (error) refuse_path(folder, fmt::format("the folder cannot be made ({}).", error.message()));
  made_.assign(missing.rbegin(), missing.rend());
}

ResultFolderGuard::~ResultFolderGuard() {
  std::error_code not_empty;
  for (; !made_.empty(); made_.pop_back()) fs::remove(made_.back(), not_empty);
}

void check_is_there(const fs::path& recording) {
  std::error_code error;
  if (fs::status(recording, error).type() == fs::file_type::not_found) refuse_missing(recording);
}

Watch watch_of(const fs::path& recording, bool quiet) {
  return until_signal(FileProgress(one_line(recording.string(), 200), quiet));
}

int jobs_at_once(const BatchOptions& options) {
  return options.jobs > 0 ? options.jobs : std::max(1, allowed_processors());
}

int threads_for_each(const BatchOptions& options, std::size_t recordings) {
  const int jobs = jobs_at_once(options);
  return jobs / int(std::clamp(recordings, std::size_t{1}, std::size_t(jobs)));
}

std::vector<RecordingTask> tasks_of(const BatchOptions& options) {
  RecordingList list = list_recordings(options);
  if (!list.passed_over.empty() && !options.quiet) tell(passed_over_text(list.passed_over));
  return std::move(list.tasks);
}

}  // namespace rheocyte
