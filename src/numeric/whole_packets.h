// Arrays that the processor works on several numbers at a time.
#pragma once
#include <cstddef>

namespace rheocyte {

/// The least length of whole packets that holds so many numbers. Functions such as exp of a packet and of a single
/// number differ in the last digit: over whole packets the result of one event does not depend on who stands beside it.
inline std::ptrdiff_t whole_packets(std::size_t count) { return static_cast<std::ptrdiff_t>((count + 15) / 16 * 16); }

}  // namespace rheocyte
