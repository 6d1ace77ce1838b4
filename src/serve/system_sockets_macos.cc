// Compiled, not run (tools/macos).
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>

#include "serve/system_sockets.h"

namespace rheocyte {

/// The system has no table of sockets that a program may read.
bool peer_is_own_user(SystemSocket) { return false; }

bool peer_has_left(SystemSocket peer) {
  const int socket = static_cast<int>(peer);
  pollfd asked{socket, POLLIN, 0};
  if (::poll(&asked, 1, 0) <= 0) return false;
  char next = 0;
  const auto count = ::recv(socket, &next, 1, MSG_PEEK | MSG_DONTWAIT);
  return count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR);
}

void keep_to_this_process(SystemSocket socket) { ::fcntl(static_cast<int>(socket), F_SETFD, FD_CLOEXEC); }

}  // namespace rheocyte
