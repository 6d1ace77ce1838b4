// What POSIX leaves open where a process starts another one.
#pragma once

namespace rheocyte {

/// Two descriptors that programs started later do not get: the ends of a pipe, first the one to read from, and two
/// sockets that are connected. 0, or -1 (errno).
int make_pipe(int (&ends)[2]);
int make_sockets(int (&ends)[2]);

/// Among the flags of send(): an error rather than a signal if no one reads.
extern const int without_signal;

/// This process gets the signal when the thread that started it ends. Nothing where the system has no such thing.
void end_with_parent(int signal);

/// The text of an error (errno), by a call that is safe between fork and exec.
const char* error_text(int error);

}  // namespace rheocyte
