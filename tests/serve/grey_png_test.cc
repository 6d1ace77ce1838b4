// A PNG is what the standard says, to the last checksum.
#include "serve/grey_png.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace rheocyte::grey_png_test {
namespace {

std::string hex(const std::string& bytes) {
  std::string text;
  for (const unsigned char c : bytes) {
    constexpr std::string_view digits = "0123456789abcdef";
    text += digits[c >> 4U];
    text += digits[c & 0xfU];
  }
  return text;
}

// Checksums by Python's zlib.
TEST(GreyPng, OfTwoPixelsIsWrittenByteForByte) {
  const std::array<std::uint8_t, 2> pixels{0, 255};
  EXPECT_EQ(hex(grey_png({2, 1}, pixels)),
            "89504e470d0a1a0a"
            "0000000d4948445200000002000000010800000000d1492056"
            "0000000e494441547801010300fcff0000ff01020100b7012ef7"
            "0000000049454e44ae426082");
}

TEST(GreyPng, OfAWholeCameraHasSeveralBlocks) {
  const std::vector<std::uint8_t> pixels(1280 * 80, 7);
  const std::string file = grey_png({1280, 80}, pixels);
  const std::size_t content = 1281 * 80, blocks = 2;
  EXPECT_EQ(file.size(), 8 + 3 * 12 + 13 + content + 5 * blocks + 2 + 4);
}

}  // namespace
}  // namespace rheocyte::grey_png_test
