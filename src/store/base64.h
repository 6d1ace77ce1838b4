// Numbers in JSON as base64 of their bytes, little endian.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace rheocyte {

std::string base64(std::span<const std::uint8_t> bytes);

template <class Number>
std::string base64_of(const Number* numbers, std::size_t count) {
  return base64({reinterpret_cast<const std::uint8_t*>(numbers), count * sizeof(Number)});
}

/// The bytes of a text, nothing if it is no base64.
bool decode_base64(std::string_view text, std::string& bytes);

}  // namespace rheocyte
