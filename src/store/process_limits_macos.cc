// Compiled, not run (tools/macos).
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <new>
#include <string_view>

#include "store/process_limits.h"

namespace rheocyte {

namespace {

constexpr rlim_t min_stack = 1 << 20;
constexpr std::string_view no_memory =
    "rheocyte: the memory of this machine does not suffice; a larger numerics.accuracy needs less. What was finished "
    "is kept.\n";

int code_without_memory = 1;

[[noreturn]] void end_now() {
  static_cast<void>(!::write(STDERR_FILENO, no_memory.data(), no_memory.size()));
  ::_exit(code_without_memory);
}

}  // namespace

std::string secure_stack(char**) {
  rlimit stack{};
  if (::getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= min_stack) return {};
  return fmt::format("rheocyte: the stack is limited to {} kB; at least {} kB are needed (ulimit -s 8192).",
                     stack.rlim_cur >> 10U, min_stack >> 10U);
}

int allowed_processors() { return 0; }

std::size_t open_files_limit() {
  constexpr std::size_t usual = 256;
  rlimit files{};
  return ::getrlimit(RLIMIT_NOFILE, &files) == 0 ? static_cast<std::size_t>(files.rlim_cur) : usual;
}

void keep_freed_memory() {}

void end_without_memory(int exit_code) {
  code_without_memory = exit_code;
  std::set_new_handler(end_now);
}

}  // namespace rheocyte
