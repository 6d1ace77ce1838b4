// Texts without what is around them, and without capitals.
#pragma once
#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace rheocyte {

/// Without these characters at both ends.
constexpr std::string_view stripped(std::string_view text, std::string_view characters = " \t\r") {
  const auto first = text.find_first_not_of(characters);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(characters) - first + 1);
}

inline std::string in_small_letters(std::string_view text) {
  std::string small(text);
  std::ranges::transform(small, small.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return small;
}

}  // namespace rheocyte
