#include "numeric/number_from_chars.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>

namespace rheocyte {

namespace {

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A decimal number as it is written: [-] digits [. digits] [e [+-] digits].
struct Decimal {
  const char* end = nullptr;  ///< nullptr: there is no number
  bool is_negative = false;
  std::uint64_t digits = 0;  ///< all of them, while `is_short`
  bool is_short = true;      ///< `digits` and its power of ten are exact in double
  bool is_zero = true;
  int exponent = 0;
};

constexpr std::uint64_t most_exact = std::uint64_t{1} << 53U;
constexpr std::array powers_of_ten{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                   1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// Returns the place behind the digits.
const char* take_digits(const char* at, const char* last, Decimal& decimal) {
  for (; at != last && is_digit(*at); ++at) {
    const auto digit = static_cast<std::uint64_t>(*at - '0');
    decimal.is_zero = decimal.is_zero && digit == 0;
    decimal.is_short = decimal.is_short && decimal.digits <= (most_exact - digit) / 10;
    if (decimal.is_short) decimal.digits = 10 * decimal.digits + digit;
  }
  return at;
}

/// An exponent without digits is none.
void take_exponent(const char* at, const char* last, Decimal& decimal) {
  if (at == last || (*at != 'e' && *at != 'E')) return;
  ++at;
  const bool is_negative = at != last && *at == '-';
  if (at != last && (*at == '-' || *at == '+')) ++at;
  if (at == last || !is_digit(*at)) return;
  constexpr int enough = 1'000'000;
  int exponent = 0;
  for (; at != last && is_digit(*at); ++at)
    if (exponent < enough) exponent = 10 * exponent + (*at - '0');
  decimal.exponent += is_negative ? -exponent : exponent;
  decimal.end = at;
}

Decimal decimal_at(const char* first, const char* last, std::chars_format format) {
  Decimal decimal{.is_negative = first != last && *first == '-'};
  const char* const start = decimal.is_negative ? first + 1 : first;
  const char* at = take_digits(start, last, decimal);
  bool has_digits = at != start;
  if (at != last && *at == '.') {
    const char* const behind = take_digits(at + 1, last, decimal);
    decimal.exponent = -static_cast<int>(std::min<std::ptrdiff_t>(behind - at - 1, 1'000'000));
    has_digits = has_digits || behind != at + 1;
    if (has_digits) at = behind;
  }
  if (!has_digits) return decimal;
  decimal.end = at;
  if (format == std::chars_format::general) take_exponent(at, last, decimal);
  return decimal;
}

bool begins_with(std::string_view text, std::string_view small_letters) {
  if (text.size() < small_letters.size()) return false;
  for (std::size_t i = 0; i < small_letters.size(); ++i)
    if ((text[i] | 0x20) != small_letters[i]) return false;
  return true;
}

/// "nan(word)" with letters, digits and lines: the length of what is in brackets, with them.
std::size_t length_of_brackets(std::string_view text) {
  if (!text.starts_with('(')) return 0;
  const std::size_t end = text.find_first_not_of("0123456789_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ", 1);
  return end != std::string_view::npos && text[end] == ')' ? end + 1 : 0;
}

std::from_chars_result word_at(const char* first, const char* last, double& value) {
  const bool is_negative = first != last && *first == '-';
  const std::string_view text(is_negative ? first + 1 : first, last);
  const double sign = is_negative ? -1 : 1;
  if (begins_with(text, "inf")) {
    value = std::copysign(std::numeric_limits<double>::infinity(), sign);
    return {text.data() + (begins_with(text, "infinity") ? 8 : 3), std::errc()};
  }
  if (begins_with(text, "nan")) {
    value = std::copysign(std::numeric_limits<double>::quiet_NaN(), sign);
    return {text.data() + 3 + length_of_brackets(text.substr(3)), std::errc()};
  }
  return {first, std::errc::invalid_argument};
}

}  // namespace

// Two exact numbers have a correctly rounded product and quotient (Clinger 1990).
std::from_chars_result number_without_library(const char* first, const char* last, double& value,
                                              std::chars_format format) {
  const Decimal decimal = decimal_at(first, last, format);
  if (!decimal.end) return word_at(first, last, value);
  double size = 0;
  constexpr int most = static_cast<int>(powers_of_ten.size()) - 1;
  if (decimal.is_short && std::abs(decimal.exponent) <= most) {
    const auto digits = static_cast<double>(decimal.digits);
    const double power = powers_of_ten.at(static_cast<std::size_t>(std::abs(decimal.exponent)));
    size = decimal.exponent < 0 ? digits / power : digits * power;
  } else if (!decimal.is_zero) {
    size = std::strtod(std::string(first + (decimal.is_negative ? 1 : 0), decimal.end).c_str(), nullptr);
    if (size == 0 || std::isinf(size)) return {decimal.end, std::errc::result_out_of_range};
  }
  value = decimal.is_negative ? -size : size;
  return {decimal.end, std::errc()};
}

std::from_chars_result number_from_chars(const char* first, const char* last, double& value, std::chars_format format) {
#ifdef __cpp_lib_to_chars
  return std::from_chars(first, last, value, format);
#else
  return number_without_library(first, last, value, format);
#endif
}

}  // namespace rheocyte
