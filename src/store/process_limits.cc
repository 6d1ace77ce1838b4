#include "store/process_limits.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <new>
#include <string_view>

#include "store/thread.h"

namespace rheocyte {

namespace {

constexpr rlim_t min_stack = 1 << 20;
constexpr std::string_view no_memory =
    "rheocyte: the memory does not suffice (of this machine, or the limit of ulimit -v); a larger numerics.accuracy "
    "needs "
    "less. What was finished is kept.\n";

int code_without_memory = 1;

[[noreturn]] void end_now() {
  static_cast<void>(!::write(STDERR_FILENO, no_memory.data(), no_memory.size()));
  ::_exit(code_without_memory);
}

}  // namespace

std::string lift_stack_limit(char** arguments) {
  rlimit stack{};
  if (::getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= min_stack) return {};
  if (stack.rlim_max >= min_stack) {
    stack.rlim_cur = std::min<rlim_t>(usual_stack, stack.rlim_max);
    if (::setrlimit(RLIMIT_STACK, &stack) == 0) ::execv("/proc/self/exe", arguments);
  }
  return fmt::format("rheocyte: the stack is limited to {} kB; at least {} kB are needed (ulimit -s {}).",
                     stack.rlim_max >> 10U, min_stack >> 10U, usual_stack >> 10U);
}

void end_without_memory(int exit_code) {
  code_without_memory = exit_code;
  std::set_new_handler(end_now);
}

}  // namespace rheocyte
