// What a program has said last.
#pragma once
#include <string>
#include <string_view>

namespace rheocyte {

/// Adds a piece of what was printed and forgets what is far from the end.
void keep_tail(std::string& tail, std::string_view piece);

/// The last line with anything in it.
std::string last_line_of(const std::string& tail);

}  // namespace rheocyte
