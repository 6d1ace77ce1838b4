#include "store/standard_error.h"

#include <cstdio>

namespace rheocyte {

void tell(const std::string& line) noexcept { std::fprintf(stderr, "%s\n", line.c_str()); }

}  // namespace rheocyte
