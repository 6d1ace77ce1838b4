// SIGINT, SIGTERM and SIGHUP as a wish that the program polls.
#pragma once
#include <atomic>

namespace rheocyte {

/// What a second signal does.
enum class SecondSignal {
  ends,  ///< the process, at once: for work that polls rarely
  waits  ///< like the first: for a process that is never busy for long and has files to remove
};

/// Installs the handlers. Also lets a closed pipe and a file size limit come back as errors of the write itself.
void watch_signals(SecondSignal second = SecondSignal::ends);

/// Becomes true with the first signal.
const std::atomic<bool>& stop_wanted();

/// Thrown where work ends half done because a signal came.
struct StoppedBySignal {};

/// The number of the signal that came, 0 if none.
int signal_received();

}  // namespace rheocyte
