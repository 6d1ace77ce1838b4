#include "store/recording_progress.h"

#include <fmt/format.h>

#include "case/user_error.h"
#include "store/standard_error.h"

namespace rheocyte {

RecordingProgress::RecordingProgress(const std::filesystem::path& recording, bool quiet)
    : name_(one_line(recording.string(), 200)), quiet_(quiet) {}

void RecordingProgress::operator()(double fraction) {
  const auto now = std::chrono::steady_clock::now();
  if (quiet_ || now - last_ < std::chrono::seconds(2)) return;
  last_ = now;
  tell(fmt::format("{}: {:.0f} %", name_, 100 * fraction));
}

}  // namespace rheocyte
