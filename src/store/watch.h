// Who watches long work: is told how far it has come, and may want its end.
#pragma once
#include <functional>

#include "store/progress.h"
#include "store/stop_signal.h"

namespace rheocyte {

struct Watch {
  TellProgress progress = [](double) {};              ///< what it throws ends the work and comes through
  std::function<bool()> stop = [] { return false; };  ///< asked several times a second

  /// For work to call from step to step: StoppedBySignal once its end is wanted.
  void go_on() const {
    if (stop()) throw StoppedBySignal{};
  }
};

/// Whose end SIGINT, SIGTERM and SIGHUP want.
inline Watch until_signal(TellProgress progress = [](double) {}) {
  return {std::move(progress), [] { return stop_wanted().load(); }};
}

}  // namespace rheocyte
