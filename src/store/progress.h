// How far a long computation has come.
#pragma once
#include <chrono>
#include <functional>
#include <string>

namespace rheocyte {

/// How work reports that it goes on; `fraction` is in [0, 1].
using TellProgress = std::function<void(double fraction)>;

/// As `tell`, but called as often as one likes it calls that only a few times a second.
std::function<void()> now_and_then(std::function<void()> tell);

/// Of one file: lines "NAME: 40 %" on standard error where that is a terminal, at most one in two seconds, and none
/// that says what is known.
class FileProgress {
 public:
  FileProgress(std::string name, bool quiet) : name_(std::move(name)), quiet_(quiet) {}
  void operator()(double fraction);

 private:
  std::string name_;
  bool quiet_;
  int percent_ = 0;  ///< as reported last
  std::chrono::steady_clock::time_point last_line_ = std::chrono::steady_clock::now();
};

/// Of things that are counted: a bar on a terminal, plain lines elsewhere.
class Progress {
 public:
  /// `what` is counted, e.g. "radii"; `done` of `total` were there before.
  Progress(std::string what, int total, int done, bool quiet);
  void show(int done);
  /// Ends the line of the bar.
  void finish();

 private:
  std::string rate_and_rest(int done) const;

  std::string what_;
  int total_, at_start_, shown_ = -1;
  bool quiet_, terminal_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), last_line_ = start_;
};

}  // namespace rheocyte
