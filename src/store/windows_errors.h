// Numbers of errors as POSIX has them (errno), and texts as Windows has them.
#pragma once
#include <string>

namespace rheocyte {

/// Of the last call that failed in this thread; EWOULDBLOCK for what another program has.
int last_error();

std::wstring wide(const std::string& utf8);
std::string narrow(const wchar_t* text);

/// Waits a moment.
void pause_ms(int milliseconds);

/// Whether a file that is in use elsewhere may be the reason of an error.
bool may_be_in_use(int error);

/// Calls until it is done (0) or fails for another reason than that somebody has the file open at this moment, as
/// programs that look for viruses have; at most two seconds. `call` returns 0 or the number of the error.
template <class Call>
int patiently(const Call& call) {
  constexpr int rounds = 100, pause = 20;
  int failed = call();
  for (int i = 0; i < rounds && may_be_in_use(failed); ++i) {
    pause_ms(pause);
    failed = call();
  }
  return failed;
}

}  // namespace rheocyte
