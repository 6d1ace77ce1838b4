// When work is to be given up, and how many threads may share it.
#pragma once
#include <atomic>

namespace rheocyte {

struct WorkLimits {
  const std::atomic<bool>* stop = nullptr;  ///< once it is set; null: never
  int threads = 1;                          ///< at most; results do not depend on it

  WorkLimits() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): most callers only want to be able to stop
  WorkLimits(const std::atomic<bool>* until, int at_most = 1) : stop(until), threads(at_most) {}
  bool is_stopped() const { return stop && *stop; }
};

}  // namespace rheocyte
