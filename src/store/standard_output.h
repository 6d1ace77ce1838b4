// What the user asked for, on standard output.
#pragma once
#include <string_view>

namespace rheocyte {

/// A full disk or a reader that has gone ends no computation; finish_output() says so.
void print(std::string_view text) noexcept;

/// Flushes. Returns 0 if everything was printed or the reader of a pipe has gone, else the number of the error.
int finish_output() noexcept;

}  // namespace rheocyte
