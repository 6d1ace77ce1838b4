#include "store/process_limits.h"

#include <fmt/format.h>
#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <new>
#include <string_view>

#include "store/thread.h"

namespace rheocyte {

namespace {

constexpr rlim_t min_stack = 1 << 20;
constexpr std::string_view no_memory =
    "rheocyte: the memory does not suffice (of this machine, or the limit of ulimit -v); a larger numerics.accuracy "
    "needs less. What was finished is kept.\n";

int code_without_memory = 1;

[[noreturn]] void end_now() {
  static_cast<void>(!::write(STDERR_FILENO, no_memory.data(), no_memory.size()));
  ::_exit(code_without_memory);
}

/// Memory for the stack is taken now or never: when it is wanted later and there is none, the system ends the program
/// without a word.
[[gnu::noinline]] void take_stack() {
  constexpr std::size_t taken = min_stack / 4 * 3, page = 4096;
  void* const room = ::mmap(nullptr, taken, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) end_now();
  ::munmap(room, taken);
  std::array<volatile char, taken> stack;
  for (std::size_t i = 0; i < taken; i += page) stack[taken - 1 - i] = 0;
}

}  // namespace

std::string secure_stack(char** arguments) {
  rlimit stack{};
  if (::getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= min_stack) {
    take_stack();
    return {};
  }
  if (stack.rlim_max >= min_stack) {
    stack.rlim_cur = std::min<rlim_t>(usual_stack, stack.rlim_max);
    if (::setrlimit(RLIMIT_STACK, &stack) == 0) ::execv("/proc/self/exe", arguments);
  }
  return fmt::format("rheocyte: the stack is limited to {} kB; at least {} kB are needed (ulimit -s {}).",
                     stack.rlim_max >> 10U, min_stack >> 10U, usual_stack >> 10U);
}

int allowed_processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return ::sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 0;
}

std::size_t open_files_limit() {
  constexpr std::size_t usual = 1024;
  rlimit files{};
  return ::getrlimit(RLIMIT_NOFILE, &files) == 0 ? static_cast<std::size_t>(files.rlim_cur) : usual;
}

void keep_freed_memory() {
  ::mallopt(M_MMAP_THRESHOLD, 1 << 30);
  ::mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

void end_without_memory(int exit_code) {
  code_without_memory = exit_code;
  std::set_new_handler(end_now);
}

}  // namespace rheocyte
