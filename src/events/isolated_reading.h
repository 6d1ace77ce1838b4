// Recordings are read in a process of their own: HDF5 is known to break down on damaged files, and must not take the
// program along.
#pragma once
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "case/user_error.h"
#include "events/options.h"
#include "store/isolated.h"

namespace rheocyte {

/// What work(report_progress) returns in a child, as bytes (store/bytes.h). UserError for what is wrong with the
/// recording, and if HDF5 broke down on it or was silent for too long; StoppedBySignal if the watch wanted that.
template <class Work>
auto read_isolated(const std::filesystem::path& recording, const MeasuringOptions& measuring, const Watch& watch,
                   const Work& work) {
  const Isolation limits{.patience_s = measuring.patience_s.value_or(default_patience_s)};
  auto done = run_isolated(work, limits, watch);
  if (done.stopped()) throw StoppedBySignal{};
  if (done.end.kind == IsolatedEnd::Kind::own_error) throw std::runtime_error(done.end.text);
  if (!done.finished()) throw UserError(sentence_for(recording, done.end, limits.patience_s));
  return std::move(done.result);
}

}  // namespace rheocyte
