// Numbers of things in sentences.
#pragma once
#include <fmt/format.h>

#include <string>
#include <string_view>

namespace rheocyte {

/// "1 step", "2 steps".
inline std::string plural(int number, std::string_view thing) {
  return fmt::format("{} {}{}", number, thing, number == 1 ? "" : "s");
}

}  // namespace rheocyte
