// What other objects call of fmt's shared library, as functions of librheocyte_cell: fmt in its variant of headers
// only.
#ifndef FMT_HEADER_ONLY
#define FMT_HEADER_ONLY
#endif
#include <fmt/format.h>

#include <string>

namespace rheocyte {
namespace {

/// Never called: it brings the functions of fmt into the library.
[[gnu::used]] std::string formatted_inside(fmt::string_view text, fmt::format_args arguments) {
  return fmt::vformat(text, arguments);
}

}  // namespace
}  // namespace rheocyte
