// Eigen asks malloc() for its memory and throws std::bad_alloc without it; but its matrices have given up their old
// memory by then, which their destructors free a second time. So the linker leads the program's own calls here
// (--wrap), where a lack of memory ends the program as it does for operator new (store/process_limits.h).
#include <cstddef>
#include <new>

// The names are those of the linker.
// NOLINTBEGIN(bugprone-reserved-identifier, readability-identifier-naming)
extern "C" {

void* __real_malloc(std::size_t bytes);
void* __real_realloc(void* old, std::size_t bytes);

void* __wrap_malloc(std::size_t bytes) {
  void* const memory = __real_malloc(bytes);
  if (const auto end = std::get_new_handler(); !memory && bytes > 0 && end) end();
  return memory;
}

void* __wrap_realloc(void* old, std::size_t bytes) {
  void* const memory = __real_realloc(old, bytes);
  if (const auto end = std::get_new_handler(); !memory && bytes > 0 && end) end();
  return memory;
}
}
// NOLINTEND(bugprone-reserved-identifier, readability-identifier-naming)
