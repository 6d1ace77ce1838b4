// What the shell learns from the program.
#pragma once
#include "store/stop_signal.h"

namespace rheocyte {

inline constexpr int exit_converged = 0;
inline constexpr int exit_own_bug = 1;  ///< a failure that neither the user nor the physics explains
inline constexpr int exit_user_error = 2;
inline constexpr int exit_numerical = 3;  ///< the last converged state is written

/// After a wish to stop: 129 for SIGHUP, 130 for SIGINT, 143 for SIGTERM.
inline int exit_stopped() { return 128 + signal_received(); }
inline bool was_stopped(int exit_code) { return exit_code > 128; }

}  // namespace rheocyte
