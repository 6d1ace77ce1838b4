#include "numeric/md5.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace rheocyte {

namespace {

constexpr std::size_t block_bytes = 64;
constexpr int steps = 64;
constexpr std::array<std::array<int, 4>, 4> rotations{
    {{7, 12, 17, 22}, {5, 9, 14, 20}, {4, 11, 16, 23}, {6, 10, 15, 21}}};

using State = std::array<std::uint32_t, 4>;

std::uint32_t sine(int step) { return static_cast<std::uint32_t>(std::floor(std::abs(std::sin(step + 1.0)) * 0x1p32)); }

std::uint32_t mixed(int round, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  switch (round) {
    case 0: return (b & c) | (~b & d);
    case 1: return (d & b) | (~d & c);
    case 2: return b ^ c ^ d;
    default: return c ^ (b | ~d);
  }
}

std::size_t word_of(int round, int step) {
  constexpr std::array<int, 4> factor{1, 5, 3, 7}, offset{0, 1, 5, 0};
  return static_cast<std::size_t>(factor[std::size_t(round)] * step + offset[std::size_t(round)]) % 16;
}

std::uint32_t little_endian(std::string_view bytes) {
  std::uint32_t word = 0;
  for (std::size_t k = 0; k < 4; ++k) word |= std::uint32_t{static_cast<unsigned char>(bytes[k])} << 8 * k;
  return word;
}

void take_block(State& state, std::string_view block) {
  auto [a, b, c, d] = state;
  for (int step = 0; step < steps; ++step) {
    const int round = step / 16, turn = rotations[std::size_t(round)][std::size_t(step % 4)];
    const std::uint32_t word = little_endian(block.substr(4 * word_of(round, step), 4));
    const std::uint32_t sum = a + mixed(round, b, c, d) + sine(step) + word;
    a = d;
    d = c;
    c = b;
    b += std::rotl(sum, turn);
  }
  state = {state[0] + a, state[1] + b, state[2] + c, state[3] + d};
}

}  // namespace

std::string md5(std::string_view bytes) {
  std::string padded(bytes);
  padded += '\x80';
  padded.append((2 * block_bytes - 8 - padded.size() % block_bytes) % block_bytes, '\0');
  for (std::size_t k = 0; k < 8; ++k) padded += static_cast<char>(8 * std::uint64_t{bytes.size()} >> 8 * k & 0xff);
  State state{0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476};
  for (std::size_t at = 0; at < padded.size(); at += block_bytes)
    take_block(state, std::string_view(padded).substr(at, block_bytes));
  std::string digits;
  for (const std::uint32_t word : state)
    for (std::size_t k = 0; k < 4; ++k) digits += fmt::format("{:02x}", word >> 8 * k & 0xff);
  return digits;
}

}  // namespace rheocyte
