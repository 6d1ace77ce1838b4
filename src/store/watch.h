// Who watches long work: receives how far it has come, and may want its end. The solvers, which ask within their
// innermost loops, have a flag in its place (fem/work_limits.h).
#pragma once
#include <functional>

#include "store/progress.h"
#include "store/stop_signal.h"

namespace rheocyte {

struct Watch {
  TellProgress progress = [](double) {};              ///< what it throws ends the work and comes through
  std::function<bool()> stop = [] { return false; };  ///< asked several times a second

  std::function<void()> alive = [] {};  ///< called at each step, for those who take silence for a hang

  /// For work to call from step to step: StoppedBySignal once its end is requested.
  void go_on() const {
    alive();
    if (stop()) throw StoppedBySignal{};
  }
};

/// Whose end SIGINT, SIGTERM and SIGHUP want.
inline Watch until_signal(TellProgress progress = [](double) {}) {
  return {std::move(progress), [] { return stop_wanted().load(); }};
}

}  // namespace rheocyte
