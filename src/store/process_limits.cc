#include "store/process_limits.h"

#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>

#include <array>

#include "store/process_limits_of_system.h"

namespace rheocyte {

const char* const whose_memory = "this machine, or the limit of ulimit -v";

/// Now or never: when it is wanted later and there is none, the system ends the program without a word.
[[gnu::noinline]] void take_stack() {
  constexpr std::size_t taken = min_stack / 4 * 3, page = 4096;
  void* const room = ::mmap(nullptr, taken, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) end_now();
  ::munmap(room, taken);
  std::array<volatile char, taken> stack;
  for (std::size_t i = 0; i < taken; i += page) stack[taken - 1 - i] = 0;
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
