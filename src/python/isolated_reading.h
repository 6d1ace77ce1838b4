// Recordings are read in a child of the process: HDF5 is known to break down on damaged files, and must not take the
// interpreter along.
#pragma once
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <atomic>
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>

#include "case/user_error.h"
#include "events/options.h"
#include "python/shared_memory.h"
#include "store/isolated.h"

namespace rheocyte {

using PythonProgress = std::optional<std::function<void(double)>>;

/// Calls the function of a Python program from a thread without the interpreter's lock.
inline void tell(const PythonProgress& progress, double fraction) {
  if (!progress) return;
  const pybind11::gil_scoped_acquire acquired;
  (*progress)(fraction);
}

/// What work(report_progress) returns in a child, as bytes (store/bytes.h); nothing if it was stopped. UserError for
/// what is wrong with the file, and if HDF5 broke down on it or was silent for too long. What `progress` throws ends
/// the work and comes through.
template <class Work>
auto read_isolated(const std::filesystem::path& file, const MeasuringOptions& options, const Work& work,
                   const PythonProgress& progress, const std::atomic<bool>& stop) {
  std::exception_ptr thrown;
  Isolation limits;
  limits.memory_bytes += taken_addresses();
  limits.patience_s = options.patience_s.value_or(default_patience_s);
  limits.is_wanted = [&] { return !stop && !thrown; };
  auto done = run_isolated(work, limits, [&](double fraction) {
    if (thrown) return;
    try {
      tell(progress, fraction);
    } catch (...) {
      thrown = std::current_exception();
    }
  });
  if (thrown) std::rethrow_exception(thrown);
  if (done.end.kind == IsolatedEnd::Kind::own_error) throw std::runtime_error(done.end.text);
  if (!done.finished() && !done.stopped()) throw UserError(sentence_for(file, done.end, limits.patience_s));
  return std::move(done.result);
}

}  // namespace rheocyte
