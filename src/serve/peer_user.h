// Whose program is at the other end of a connection.
#pragma once

namespace rheocyte {

/// Whether the other end of this TCP socket belongs to the user who runs this program, on this machine. False also
/// where the system does not tell (/proc/net).
bool peer_is_own_user(int socket);

}  // namespace rheocyte
