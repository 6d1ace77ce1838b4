// Lists in sentences.
#pragma once
#include <fmt/format.h>

#include <string>
#include <string_view>

namespace rheocyte {

/// The items with a separator between; fmt::join does the same, and costs seconds in each file that uses it.
template <class Items>
std::string joined(const Items& items, std::string_view separator) {
  std::string text;
  for (const auto& item : items) {
    if (!text.empty()) text += separator;
    text += fmt::format("{}", item);
  }
  return text;
}

}  // namespace rheocyte
