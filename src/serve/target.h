// What a request asks for: path and query, as they stand in its first line.
#pragma once
#include <string>
#include <string_view>

#include "serve/http.h"

namespace rheocyte {

struct Target {
  std::string path;  ///< percent-decoded
  Request::Names query;
};

/// "/a%20b?x=1&y=a+b". Percent signs that begin no byte stay as they are; of two values of a name the later one counts.
Target read_target(std::string_view);

}  // namespace rheocyte
