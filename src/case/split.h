// Texts with separators.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace rheocyte {

/// The parts between separators: "a,,b" is "a", "", "b", an empty text one empty part.
inline std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (;;) {
    const auto end = text.find(separator);
    parts.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// The lines of a text, whether or not the last one has its end.
inline std::vector<std::string> text_lines(std::string_view text) {
  std::vector<std::string> lines = split(text, '\n');
  if (lines.back().empty()) lines.pop_back();
  return lines;
}

}  // namespace rheocyte
