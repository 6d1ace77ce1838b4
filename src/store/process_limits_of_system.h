// What store/process_limits.h needs of each system, and what the systems share for it.
#pragma once
#include <cstddef>

namespace rheocyte {

/// What may have too little memory, within a sentence.
extern const char* const whose_memory;

/// The end that end_without_memory has set.
[[noreturn]] void end_now();

inline constexpr std::size_t min_stack = std::size_t{1} << 20U;

/// Takes the memory of most of a stack of that size, where the system would give it only when it is wanted.
void take_stack();

}  // namespace rheocyte
