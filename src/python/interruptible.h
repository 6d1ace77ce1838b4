// Long work for Python: without the interpreter's lock, and ended by Ctrl-C.
#pragma once
#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <optional>
#include <utility>

#include "store/thread.h"

namespace rheocyte {

/// How often the interpreter is asked for signals.
inline constexpr std::chrono::milliseconds between_looks{50};

/// Waits for `is_ready(duration)` with the lock held by others; returns what a signal's handler threw
/// (KeyboardInterrupt), if one did. To be called with the lock.
template <class IsReady>
std::optional<pybind11::error_already_set> wait_or_interrupt(const IsReady& is_ready) {
  const pybind11::gil_scoped_release released;
  while (!is_ready(between_looks)) {
    const pybind11::gil_scoped_acquire acquired;
    if (PyErr_CheckSignals() != 0) return pybind11::error_already_set();
  }
  return {};
}

/// Runs work(stop) in a thread of its own. Ctrl-C sets `stop`, which the work polls, and is raised when it has ended.
template <class Work>
auto interruptible(Work work) {
  using Result = std::invoke_result_t<Work&, const std::atomic<bool>&>;
  std::atomic<bool> stop{false};
  std::packaged_task<Result()> task([&] { return work(stop); });
  auto future = task.get_future();
  Thread thread([&task](const std::stop_token&) { task(); });
  const auto interruption =
      wait_or_interrupt([&](auto duration) { return future.wait_for(duration) == std::future_status::ready; });
  if (interruption) stop = true;
  {
    const pybind11::gil_scoped_release released;
    thread.join();
  }
  if (interruption) throw *interruption;
  return future.get();
}

}  // namespace rheocyte
