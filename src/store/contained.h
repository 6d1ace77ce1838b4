// Work that may break its process, done in a process of its own: HDF5 is known to crash on some damaged files.
#pragma once
#include <functional>
#include <string>

namespace rheocyte {

/// What the contained work may use.
struct Containment {
  std::size_t memory_bytes = std::size_t{4} << 30U;
  double patience_s = 60;  ///< without a word of progress it counts as hanging
};

struct ContainedEnd {
  enum class Kind {
    finished,    ///< `text` is what the work returned
    user_error,  ///< `text` is the sentence
    own_error,   ///< another exception; `text` says which
    broke_down,  ///< a signal ended it; `text` names it
    no_memory,   ///< the limit was reached
    hung,        ///< killed, because it was silent for too long
    stopped      ///< killed, because the user wants to stop
  };
  Kind kind = Kind::broke_down;
  std::string text;
};

/// Tells the parent that the work goes on; `fraction` is in [0, 1].
using TellProgress = std::function<void(double fraction)>;

/// Forks, runs `work` in the child and returns what became of it. The child prints nothing. `on_progress` is called in
/// the parent. The process must have a single thread.
ContainedEnd run_contained(const std::function<std::string(const TellProgress&)>& work, const Containment& limits,
                           const TellProgress& on_progress);

}  // namespace rheocyte
