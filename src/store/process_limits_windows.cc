#include <windows.h>

#include <bit>

#include "store/process_limits.h"
#include "store/process_limits_of_system.h"

namespace rheocyte {

const char* const whose_memory = "this machine";

/// The linker has set it.
std::string secure_stack(char**) { return {}; }

int allowed_processors() {
  DWORD_PTR mine = 0, all = 0;
  return ::GetProcessAffinityMask(::GetCurrentProcess(), &mine, &all) ? std::popcount(mine) : 0;
}

std::size_t open_files_limit() {
  constexpr std::size_t of_the_runtime = 2048;
  return of_the_runtime;
}

void keep_freed_memory() {}

}  // namespace rheocyte
