// An answer as it is written.
#pragma once
#include <string>

#include "serve/http.h"

namespace rheocyte {

enum class Length {
  known,    ///< that of the body
  pieces,   ///< each piece brings its own
  unknown,  ///< the end of the connection is its end: for clients of HTTP 1.0
};

/// The head, with the headers that keep other pages out, and the empty line behind it. `reason` is the phrase of the
/// status.
std::string head_text(const Answer&, std::string_view reason, Length, bool is_last);

}  // namespace rheocyte
