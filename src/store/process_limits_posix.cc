// What Linux and macOS share.
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

#include "store/process_limits.h"
#include "store/process_limits_of_system.h"
#include "store/program_file.h"
#include "store/thread.h"

namespace rheocyte {

std::string secure_stack(char** arguments) {
  rlimit stack{};
  if (::getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= min_stack) {
    take_stack();
    return {};
  }
  if (stack.rlim_max >= min_stack) {
    stack.rlim_cur = std::min<rlim_t>(usual_stack, stack.rlim_max);
    if (::setrlimit(RLIMIT_STACK, &stack) == 0) ::execv(program_file().c_str(), arguments);
  }
  return fmt::format("rheocyte: the stack is limited to {} kB; at least {} kB are needed (ulimit -s {}).",
                     stack.rlim_max >> 10U, min_stack >> 10U, usual_stack >> 10U);
}

std::size_t open_files_limit() {
  constexpr std::size_t least_usual = 256;
  rlimit files{};
  return ::getrlimit(RLIMIT_NOFILE, &files) == 0 ? static_cast<std::size_t>(files.rlim_cur) : least_usual;
}

}  // namespace rheocyte
