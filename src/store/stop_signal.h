// SIGINT, SIGTERM and SIGHUP as a wish that the solver polls; a second one ends the process at once.
#pragma once
#include <atomic>

namespace rheocyte {

/// Installs the handlers. Also lets a closed pipe and a file size limit come back as errors of the write itself.
void watch_signals();

/// Becomes true with the first signal.
const std::atomic<bool>& stop_wanted();

/// The number of the signal that came, 0 if none.
int signal_received();

}  // namespace rheocyte
