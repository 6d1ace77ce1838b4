// Lines for the user that are no result: progress, warnings, errors.
#pragma once
#include <string>

namespace rheocyte {

/// Prints one line to standard error. A closed or full standard error never ends a computation.
void tell(const std::string& line) noexcept;

}  // namespace rheocyte
