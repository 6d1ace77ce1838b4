// Compiled, not run (tools/macos).
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>

#include "store/process_start.h"

namespace rheocyte {

const int without_signal = 0;  // the sockets give none

namespace {

/// Not in one step with the making: another thread that starts a program just then leaves them to it.
int keep_to_this_process(int (&ends)[2]) {
  for (const int end : ends) ::fcntl(end, F_SETFD, FD_CLOEXEC);
  return 0;
}

}  // namespace

int make_pipe(int (&ends)[2]) { return ::pipe(ends) == 0 ? keep_to_this_process(ends) : -1; }

int make_sockets(int (&ends)[2]) {
  if (::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) return -1;
  const int wanted = 1;
  for (const int end : ends) ::setsockopt(end, SOL_SOCKET, SO_NOSIGPIPE, &wanted, sizeof wanted);
  return keep_to_this_process(ends);
}

void end_with_parent(int) {}

const char* error_text(int error) { return std::strerror(error); }

}  // namespace rheocyte
