#include "view/path_text.h"

#include "case/to_path.h"
#include "case/utf8.h"

namespace rheocyte {

namespace {

constexpr std::size_t escape_length = 4;

/// Whether the bytes are the character that stands for a byte.
bool is_escape(std::string_view bytes) {
  return bytes.size() >= escape_length && bytes[0] == '\xF4' && bytes[1] == '\x8F' &&
         (bytes[2] == '\xBE' || bytes[2] == '\xBF') && is_continuation_byte(bytes[3]);
}

/// Length of the character at the beginning; 0 if it is none, or stands for a byte.
std::size_t character_length(std::string_view bytes) {
  const std::size_t length = sequence_length(bytes[0]);
  if (length == 0 || length > bytes.size() || is_escape(bytes)) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if (!is_continuation_byte(bytes[k])) return 0;
  const auto first = static_cast<unsigned char>(bytes[0]);
  const auto second = static_cast<unsigned char>(length > 1 ? bytes[1] : 0);
  const bool is_too_long = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool is_no_character = (first == 0xED && second >= 0xA0) || (first == 0xF4 && second >= 0x90);
  return is_too_long || is_no_character ? 0 : length;
}

}  // namespace

std::string path_text(const std::filesystem::path& path) {
  const std::string bytes = path.string();
  std::string text;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t length = character_length(std::string_view(bytes).substr(at));
    if (length > 0) {
      text.append(bytes, at, length);
      at += length;
      continue;
    }
    const auto byte = static_cast<unsigned char>(bytes[at++]);
    text.append("\xF4\x8F")
        .append(1, static_cast<char>(0xBC | (byte >> 6U)))
        .append(1, static_cast<char>(0x80 | (byte & 0x3FU)));
  }
  return text;
}

std::filesystem::path path_of_text(std::string_view text) {
  std::string bytes;
  for (std::size_t at = 0; at < text.size();) {
    const bool is_byte = is_escape(text.substr(at));
    bytes += is_byte ? static_cast<char>((static_cast<unsigned char>(text[at + 2]) & 0x03U) << 6U |
                                         (static_cast<unsigned char>(text[at + 3]) & 0x3FU))
                     : text[at];
    at += is_byte ? escape_length : 1;
  }
  return to_path(bytes);
}

}  // namespace rheocyte
