// What the end without memory and the limits of the process need of each other.
#pragma once

namespace rheocyte {

/// What may have too little memory, within a sentence.
extern const char* const whose_memory;

/// The end that end_without_memory has set.
[[noreturn]] void end_now();

}  // namespace rheocyte
