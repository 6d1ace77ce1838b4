#include "measurement/any_bytes.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

#include "case/utf8.h"

namespace rheocyte {

namespace {

// U+10FF00 + byte.
std::string stand_in(unsigned char byte) {
  return {'\xF4', '\x8F', static_cast<char>(0xBC + (byte >> 6U)), static_cast<char>(0x80 + (byte & 0x3FU))};
}

bool is_stand_in(std::string_view text) {
  return text.size() >= 4 && text.starts_with("\xF4\x8F") && static_cast<unsigned char>(text[2]) >= 0xBC;
}

unsigned char byte_of(std::string_view stand_in) {
  return static_cast<unsigned char>((static_cast<unsigned char>(stand_in[2]) - 0xBCU) << 6U |
                                    (static_cast<unsigned char>(stand_in[3]) & 0x3FU));
}

// The number in "\\u" and four digits at the beginning, or -1.
int escaped_unit(std::string_view text) {
  int unit = -1;
  if (text.size() < 6 || !text.starts_with("\\u")) return -1;
  const auto [end, error] = std::from_chars(text.data() + 2, text.data() + 6, unit, 16);
  return error == std::errc() && end == text.data() + 6 ? unit : -1;
}

template <class Replace>
std::string replaced(std::string_view text, const Replace& replace) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) at += replace(text.substr(at), result);
  return result;
}

}  // namespace

std::string with_stand_ins(const std::string& bytes) {
  return replaced(bytes, [](std::string_view rest, std::string& result) -> std::size_t {
    const std::size_t length = sequence_length(rest[0]);
    const bool valid =
        length > 0 && length <= rest.size() && first_bad_byte(rest.substr(0, length)) == std::string_view::npos;
    if (valid && !is_stand_in(rest)) return result.append(rest.substr(0, length)), length;
    return result.append(stand_in(static_cast<unsigned char>(rest[0]))), 1;
  });
}

std::string without_stand_ins(const std::string& text) {
  return replaced(text, [](std::string_view rest, std::string& result) -> std::size_t {
    if (is_stand_in(rest)) return result.push_back(static_cast<char>(byte_of(rest))), 4;
    return result.push_back(rest[0]), 1;
  });
}

std::string stand_ins_escaped(const std::string& json_text) {
  return replaced(json_text, [](std::string_view rest, std::string& result) -> std::size_t {
    if (is_stand_in(rest)) return result.append(fmt::format("\\udc{:02x}", byte_of(rest))), 4;
    return result.push_back(rest[0]), 1;
  });
}

std::string escapes_as_stand_ins(const std::string& json_text) {
  return replaced(json_text, [](std::string_view rest, std::string& result) -> std::size_t {
    const int unit = escaped_unit(rest);
    if (unit >= 0xDC80 && unit <= 0xDCFF) return result.append(stand_in(static_cast<unsigned char>(unit & 0xFF))), 6;
    // A pair of surrogates is one character, and a backslash takes the next character with it.
    const std::size_t length = unit >= 0xD800 && unit < 0xDC00 ? 12 : rest[0] == '\\' ? 2 : 1;
    return result.append(rest.substr(0, length)), length;
  });
}

}  // namespace rheocyte
