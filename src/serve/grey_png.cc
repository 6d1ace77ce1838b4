#include "serve/grey_png.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string_view>

namespace rheocyte {

namespace {

void put32(std::uint32_t number, std::string& bytes) {
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(number >> shift & 0xffU);
}

/// CRC-32 of ISO 3309.
std::uint32_t checksum(std::string_view bytes) {
  static const auto table = [] {
    std::array<std::uint32_t, 256> entries{};
    for (std::uint32_t n = 0; n < entries.size(); ++n) {
      entries[n] = n;
      for (int bit = 0; bit < 8; ++bit) entries[n] = (entries[n] & 1U ? 0xedb88320U : 0U) ^ entries[n] >> 1U;
    }
    return entries;
  }();
  std::uint32_t sum = 0xffffffffU;
  for (const char c : bytes) sum = table[(sum ^ static_cast<unsigned char>(c)) & 0xffU] ^ sum >> 8U;
  return ~sum;
}

std::uint32_t adler32(std::string_view bytes) {
  constexpr std::uint32_t modulus = 65521;
  std::uint32_t a = 1, b = 0;
  for (const char c : bytes) {
    a = (a + static_cast<unsigned char>(c)) % modulus;
    b = (b + a) % modulus;
  }
  return b << 16U | a;
}

/// A zlib stream of stored blocks (RFC 1950, 1951).
std::string stored(std::string_view bytes) {
  constexpr std::size_t longest_block = 65535;
  std::string stream = "\x78\x01";
  for (std::size_t at = 0; at == 0 || at < bytes.size(); at += longest_block) {
    const std::string_view block = bytes.substr(at, longest_block);
    const auto length = static_cast<unsigned>(block.size());
    stream += at + longest_block < bytes.size() ? '\0' : '\1';  // the last one
    for (const unsigned half : {length, ~length}) {
      stream += static_cast<char>(half & 0xffU);
      stream += static_cast<char>(half >> 8U & 0xffU);
    }
    stream += block;
  }
  put32(adler32(bytes), stream);
  return stream;
}

void add_chunk(std::string_view name, const std::string& content, std::string& file) {
  put32(static_cast<std::uint32_t>(content.size()), file);
  const std::string body = std::string(name) + content;
  file += body;
  put32(checksum(body), file);
}

}  // namespace

std::string grey_png(const PictureSize& size, std::span<const std::uint8_t> pixels) {
  assert(pixels.size() == size.width * size.height);
  std::string head, rows;
  put32(static_cast<std::uint32_t>(size.width), head);
  put32(static_cast<std::uint32_t>(size.height), head);
  head += std::string_view("\x08\0\0\0\0", 5);  // 8 bit, grey, the usual ways, not interlaced
  for (std::size_t row = 0; row < size.height; ++row) {
    rows += '\0';  // no filter
    const auto line = pixels.subspan(row * size.width, size.width);
    rows.append(line.begin(), line.end());
  }
  std::string file = "\x89PNG\r\n\x1a\n";
  add_chunk("IHDR", head, file);
  add_chunk("IDAT", stored(rows), file);
  add_chunk("IEND", {}, file);
  return file;
}

}  // namespace rheocyte
