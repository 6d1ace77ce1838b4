// What the shell learns from the program.
#pragma once

namespace rheocyte {

inline constexpr int exit_converged = 0;
inline constexpr int exit_own_bug = 1;  ///< a failure that neither the user nor the physics explains
inline constexpr int exit_user_error = 2;
inline constexpr int exit_numerical = 3;  ///< the last converged state is written
inline constexpr int exit_signal = 128;   ///< plus the number of the signal: 130 SIGINT, 143 SIGTERM

}  // namespace rheocyte
