#include "store/process_start.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>

namespace rheocyte {

const int without_signal = MSG_NOSIGNAL;

int make_pipe(int (&ends)[2]) { return ::pipe2(ends, O_CLOEXEC); }

int make_sockets(int (&ends)[2]) { return ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends); }

void end_with_parent(int signal) { ::prctl(PR_SET_PDEATHSIG, signal); }

const char* error_text(int error) { return ::strerrordesc_np(error); }

}  // namespace rheocyte
