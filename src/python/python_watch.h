// A Python program as who watches long work (store/watch.h).
#pragma once
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <atomic>
#include <functional>
#include <optional>

#include "store/watch.h"

namespace rheocyte {

using PythonProgress = std::optional<std::function<void(double)>>;

/// Calls the function of a Python program from a thread without the interpreter's lock.
inline void tell(const PythonProgress& progress, double fraction) {
  if (!progress) return;
  const pybind11::gil_scoped_acquire acquired;
  (*progress)(fraction);
}

/// Both must outlive it; `stop` is that of interruptible work.
inline Watch watched_by(const PythonProgress& progress, const std::atomic<bool>& stop) {
  return {[&progress](double fraction) { tell(progress, fraction); }, [&stop] { return stop.load(); }};
}

}  // namespace rheocyte
