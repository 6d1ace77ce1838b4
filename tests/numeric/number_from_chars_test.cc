// Numbers are read from text as the library of the standard does it: the same value to the last bit, end and error.
#include "numeric/number_from_chars.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

namespace rheocyte::number_from_chars_test {
namespace {

struct Read {
  double value = 0.25;  // of a text that is not a number
  long length = 0;
  std::errc error = {};
};

Read read(const std::string& text, std::chars_format format = std::chars_format::general) {
  Read result;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = number_without_library(text.data(), end, result.value, format);
  return {result.value, stop - text.data(), error};
}

#ifdef __cpp_lib_to_chars
Read by_library(const std::string& text, std::chars_format format) {
  Read result;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, result.value, format);
  return {result.value, stop - text.data(), error};
}

void expect_same(const std::string& text, std::chars_format format = std::chars_format::general) {
  const Read ours = read(text, format), theirs = by_library(text, format);
  EXPECT_EQ(ours.length, theirs.length) << text;
  EXPECT_EQ(ours.error, theirs.error) << text;
  if (theirs.error != std::errc()) return;
  if (std::isnan(theirs.value))
    EXPECT_TRUE(std::isnan(ours.value)) << text;
  else
    EXPECT_EQ(std::bit_cast<std::uint64_t>(ours.value), std::bit_cast<std::uint64_t>(theirs.value)) << text;
}

TEST(NumberFromChars, AgreesOnHowNumbersAreWritten) {
  for (const char* text : {"",
                           "0",
                           "-0",
                           "+1",
                           " 1",
                           "1 ",
                           ".5",
                           "5.",
                           ".",
                           "-",
                           "-.",
                           "1e5",
                           "1e",
                           "1e+",
                           "1e-",
                           "1E-3x",
                           "1.5.2",
                           "0x10",
                           "1,5",
                           "12abc",
                           "e5",
                           ".e5",
                           "inf",
                           "-inf",
                           "INFINITY",
                           "infin",
                           "nan",
                           "-NaN",
                           "nan(a_1)",
                           "nan(",
                           "nan(a b)",
                           "in",
                           "--1",
                           "00012",
                           "0.0000",
                           "0e999999",
                           "1e22",
                           "1e23",
                           "9007199254740993",
                           "1.7976931348623157e308",
                           "5e-324",
                           "2.2250738585072011e-308",
                           "0.1e-1",
                           "123456789012345678901234567890",
                           "1e0000000000000000000005"})
    for (const auto format : {std::chars_format::general, std::chars_format::fixed}) expect_same(text, format);
}

TEST(NumberFromChars, AgreesOnRandomNumbersOfAllSizesToTheLastBit) {
  std::mt19937_64 random(5);
  std::array<char, 64> text{};
  for (int i = 0; i < 20'000; ++i) {
    const auto value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    for (const int digits : {6, 15, 17, 25}) {
      std::snprintf(text.data(), text.size(), "%.*e", digits - 1, value);
      expect_same(text.data());
      std::snprintf(text.data(), text.size(), "%.*g", digits, std::fmod(value, 1e6));
      expect_same(text.data());
    }
  }
}
#endif

TEST(NumberFromChars, WhatIsTooLargeOrTooSmallIsAnErrorAndLeavesTheValue) {
  for (const char* text : {"1e400", "-1e400", "1e-400", "1e99999999999999999999"}) {
    const Read result = read(text);
    EXPECT_EQ(result.error, std::errc::result_out_of_range) << text;
    EXPECT_EQ(result.value, 0.25) << text;
    EXPECT_EQ(result.length, long(std::string(text).size())) << text;
  }
  EXPECT_EQ(read("word").error, std::errc::invalid_argument);
}

TEST(NumberFromChars, TheShortestTextOfANumberGivesItBack) {
  for (const double value : {0.1, 1.0 / 3, 6.02214076e23, 1e-300, std::numeric_limits<double>::denorm_min()}) {
    std::array<char, 40> text{};
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
    ASSERT_EQ(error, std::errc());
    EXPECT_EQ(read(std::string(text.data(), end)).value, value);
  }
}

}  // namespace
}  // namespace rheocyte::number_from_chars_test
