// What each system knows of its TCP sockets in its own way.
#pragma once
#include <cstdint>

namespace rheocyte {

/// As the system counts it; -1 is none.
using SystemSocket = std::intptr_t;

/// Whether the other end belongs to the user who runs this program, on this machine. False also where the system does
/// not show it (/proc/net).
bool peer_is_own_user(SystemSocket);

/// Whether the other end has closed the connection, or its direction to us.
bool peer_has_left(SystemSocket);

/// Programs that are started, such as a browser, must not hold it.
void keep_to_this_process(SystemSocket);

}  // namespace rheocyte
