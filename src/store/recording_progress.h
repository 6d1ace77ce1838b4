// How far the work on one recording has come.
#pragma once
#include <chrono>
#include <filesystem>
#include <string>

namespace rheocyte {

/// Lines on standard error for a recording that takes long, at most one in two seconds.
class RecordingProgress {
 public:
  RecordingProgress(const std::filesystem::path& recording, bool quiet);

  /// `fraction` is in [0, 1].
  void operator()(double fraction);

 private:
  std::string name_;
  bool quiet_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace rheocyte
