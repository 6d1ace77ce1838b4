// What the user can repair: the only exception that the light floors throw on purpose.
#pragma once
#include <stdexcept>
#include <string>
#include <string_view>

namespace rheocyte {

/// Printable text on one line: control characters become "?", long text is cut and ends with "...".
std::string one_line(std::string_view text, std::size_t longest);

/// One sentence for the user: place, key, value, what is allowed, what to do. Its exit code is 2.
class UserError : public std::runtime_error {
 public:
  explicit UserError(const std::string& sentence);
};

}  // namespace rheocyte
