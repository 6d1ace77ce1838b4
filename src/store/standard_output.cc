#include "store/standard_output.h"

#include <cerrno>
#include <cstdio>

namespace rheocyte {

namespace {

int reason = 0;  // of the first failure

void note(bool good) noexcept {
  if (!good && reason == 0) reason = errno != 0 ? errno : EIO;
}

}  // namespace

void print(std::string_view text) noexcept {
  errno = 0;
  note(std::fwrite(text.data(), 1, text.size(), stdout) == text.size());
}

int finish_output() noexcept {
  errno = 0;
  note(std::fflush(stdout) == 0 && std::ferror(stdout) == 0);  // CLI11 prints there, too
  return reason == EPIPE ? 0 : reason;
}

}  // namespace rheocyte
