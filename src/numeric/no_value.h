#pragma once

#include <limits>

namespace rheocyte {

/// What is not known must not look like a number.
inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

}  // namespace rheocyte
