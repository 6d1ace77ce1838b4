// How far a long computation has come: a bar on a terminal, plain lines elsewhere.
#pragma once
#include <chrono>
#include <string>

namespace rheocyte {

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
