#include "store/process_limits.h"

#include <fmt/format.h>
#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "store/process_limits_of_system.h"
#include "store/program_file.h"
#include "store/thread.h"

namespace rheocyte {

const char* const whose_memory = "this machine, or the limit of ulimit -v";

namespace {

constexpr std::size_t min_stack = std::size_t{1} << 20U;

/// Now or never: when it is requested later and there is none, the system ends the program without a word.
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

int allowed_processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return ::sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 0;
}

void keep_freed_memory() {
  ::mallopt(M_MMAP_THRESHOLD, 1 << 30);
  ::mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

}  // namespace rheocyte
