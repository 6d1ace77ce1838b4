#include "app/recording_batch.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

namespace rheocyte {

void make_folders(std::span<const RecordingTask> tasks) {
  for (const auto& task : tasks) {
    const auto folder = task.output.companion.parent_path();
    std::error_code error;
    if (folder.empty() || std::filesystem::is_directory(folder, error)) continue;
    std::filesystem::create_directories(folder, error);
    if (error)
      throw UserError(
          fmt::format("{}: the folder cannot be made ({}).", one_line(folder.string(), 300), error.message()));
  }
}

}  // namespace rheocyte
