#include <windows.h>

#include <bit>
#include <cstdlib>
#include <new>
#include <string_view>

#include "store/process_limits.h"

namespace rheocyte {

namespace {

constexpr std::string_view no_memory =
    "rheocyte: the memory of this machine does not suffice; a larger numerics.accuracy needs less. What was finished "
    "is kept.\n";

int code_without_memory = 1;

[[noreturn]] void end_now() {
  DWORD written = 0;
  ::WriteFile(::GetStdHandle(STD_ERROR_HANDLE), no_memory.data(), no_memory.size(), &written, nullptr);
  ::_exit(code_without_memory);
}

}  // namespace

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

void end_without_memory(int exit_code) {
  code_without_memory = exit_code;
  std::set_new_handler(end_now);
}

}  // namespace rheocyte
