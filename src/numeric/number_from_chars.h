// Numbers from text, whatever the library of the standard has: that of LLVM reads whole numbers alone before LLVM 20.
#pragma once
#include <charconv>

namespace rheocyte {

/// As std::from_chars with chars_format::general or fixed: the longest beginning of the text that is a number, rounded
/// correctly, in no locale. An error leaves `value` as it is: invalid_argument, or result_out_of_range of a number that
/// is too large, or so small that it would become 0.
std::from_chars_result number_from_chars(const char* first, const char* last, double& value,
                                         std::chars_format format = std::chars_format::general);

/// The same without the library of the standard; by strtod where a number has many digits or a large exponent, in a
/// program that has set no locale.
std::from_chars_result number_without_library(const char* first, const char* last, double& value,
                                              std::chars_format format = std::chars_format::general);

}  // namespace rheocyte
