// Bytes of UTF-8.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace rheocyte {

constexpr bool is_beyond_ascii(char c) { return static_cast<unsigned char>(c) >= 0x80; }

/// Whether the byte goes on with a character that has begun before.
constexpr bool is_continuation_byte(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// Length of the character that begins with this byte; 0: none does.
constexpr std::size_t sequence_length(char c) {
  const auto first = static_cast<unsigned char>(c);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  if (first >= 0xF0 && first < 0xF5) return 4;
  return 0;
}

/// Where the character begins to which the byte at `position` belongs.
constexpr std::size_t start_of_character(std::string_view text, std::size_t position) {
  while (position > 0 && is_continuation_byte(text[position])) --position;
  return position;
}

/// The first byte that is no UTF-8, or npos.
constexpr std::size_t first_bad_byte(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = sequence_length(text[i]);
    if (length == 0 || i + length > text.size()) return i;
    for (std::size_t k = 1; k < length; ++k)
      if (!is_continuation_byte(text[i + k])) return i;
    i += length;
  }
  return std::string_view::npos;
}

/// The text with a question mark for each byte that is no UTF-8: names of files need not be any.
inline std::string valid_utf8(std::string text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bad = first_bad_byte(std::string_view(text).substr(at));
    if (bad == std::string_view::npos) break;
    at += bad;
    text[at++] = '?';
  }
  return text;
}

}  // namespace rheocyte
