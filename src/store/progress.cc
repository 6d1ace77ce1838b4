#include "store/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "store/standard_error.h"

namespace rheocyte {

namespace {

constexpr int width = 30;
constexpr double seconds_between_lines = 10, seconds_between_fractions = 2, seconds_between_words = 0.2;

std::string duration(double seconds) {
  const int s = int(std::lround(seconds));
  if (s < 90) return fmt::format("{} s", s);
  if (s < 5400) return fmt::format("{} min", (s + 30) / 60);
  return fmt::format("{:.1f} h", s / 3600.0);
}

double seconds_since(std::chrono::steady_clock::time_point time) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - time).count();
}

}  // namespace

std::function<void()> now_and_then(std::function<void()> tell) {
  return [tell = std::move(tell), last = std::chrono::steady_clock::time_point()]() mutable {
    if (seconds_since(last) < seconds_between_words) return;
    last = std::chrono::steady_clock::now();
    tell();
  };
}

void FileProgress::operator()(double fraction) {
  static const bool is_seen = ::isatty(STDERR_FILENO) == 1;  // a log is for what is said about the recording
  const int percent = static_cast<int>(100 * fraction);
  if (quiet_ || !is_seen || percent == percent_ || seconds_since(last_line_) < seconds_between_fractions) return;
  last_line_ = std::chrono::steady_clock::now();
  percent_ = percent;
  tell(fmt::format("{}: {} %", name_, percent));
}

Progress::Progress(std::string what, int total, int done, bool quiet)
    : what_(std::move(what)), total_(total), at_start_(done), quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1) {}

std::string Progress::rate_and_rest(int done) const {
  const double elapsed = seconds_since(start_);
  const int fresh = done - at_start_;
  if (fresh <= 0) return fmt::format("{} elapsed", duration(elapsed));
  return fmt::format("{:.2g} per minute, {} left", 60 * fresh / elapsed, duration((total_ - done) * elapsed / fresh));
}

void Progress::show(int done) {
  if (quiet_) return;
  if (terminal_) {
    const int filled = total_ > 0 ? width * done / total_ : width;
    std::fputs(fmt::format("\r  [{:=<{}}{: <{}}] {}/{} {}, {}   ", "", filled, "", width - filled, done, total_, what_,
                           rate_and_rest(done))
                   .c_str(),
               stderr);
    std::fflush(stderr);
  } else if (shown_ < 0 || (done != shown_ && (done == total_ || seconds_since(last_line_) > seconds_between_lines))) {
    tell(fmt::format("{} of {} {}, {}", done, total_, what_, rate_and_rest(done)));
    last_line_ = std::chrono::steady_clock::now();
    shown_ = done;
  }
}

void Progress::finish() {
  if (!quiet_ && terminal_) std::fputs("\n", stderr);
}

}  // namespace rheocyte
