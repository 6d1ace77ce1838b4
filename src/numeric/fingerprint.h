// Fingerprints of bytes (FNV-1a, 64 bit): they find every change of a single byte, but keep no secrets.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace rheocyte {

constexpr std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  return hash;
}

/// 16 hexadecimal digits.
std::string fingerprint(std::string_view bytes);

}  // namespace rheocyte
