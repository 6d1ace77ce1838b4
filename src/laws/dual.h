// Dual numbers: a value and its exact derivatives with respect to some numbers. Whatever is computed with them carries
// the derivatives along by the rules of differentiation, so that no tangent is derived by hand.
#pragma once
#include <array>
#include <cmath>
#include <type_traits>

#include "laws/constant.h"

namespace rheocyte {

/// A number and its derivatives with respect to `count` numbers; T may be a dual number itself, for second derivatives.
template <class T, int count>
struct Dual {
  using Scalar = T;
  /// Derivatives that are doubles are added and multiplied four at a time.
  static constexpr int width = std::is_same_v<T, double> ? 4 : 1;
  typedef double Four [[gnu::vector_size(32)]];
  using Pack = std::conditional_t<width == 4, Four, T>;

  T value;
  std::array<Pack, (count + width - 1) / width> packs;

  Dual() = default;
  /// A constant.
  explicit Dual(const T& constant_value) : value(constant_value), packs{} {}
  /// The number with respect to which derivative `index` is.
  Dual(const T& here, int index) : value(here), packs{} {
    if constexpr (width == 1) {
      packs[index] = constant<T>(1);
    } else {
      packs[index / width][index % width] = 1;
    }
  }

  /// The derivative with respect to number `index`.
  T slope(int index) const {
    if constexpr (width == 1) {
      return packs[index];
    } else {
      return packs[index / width][index % width];
    }
  }

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }

  friend Dual operator-(const Dual& a) { return a.composed(-a.value, constant<T>(-1)); }
  friend Dual operator+(const Dual& a, const Dual& b) {
    Dual sum;
    sum.value = a.value + b.value;
    for (std::size_t i = 0; i < a.packs.size(); ++i) sum.packs[i] = a.packs[i] + b.packs[i];
    return sum;
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    Dual difference;
    difference.value = a.value - b.value;
    for (std::size_t i = 0; i < a.packs.size(); ++i) difference.packs[i] = a.packs[i] - b.packs[i];
    return difference;
  }
  friend Dual operator*(const Dual& a, const Dual& b) { return combined(a.value * b.value, b.value, a, a.value, b); }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const T inverse = constant<T>(1) / b.value, quotient = a.value * inverse;
    return combined(quotient, inverse, a, -quotient * inverse, b);
  }

  friend Dual operator+(const Dual& a, const T& s) { return a.moved(a.value + s); }
  friend Dual operator+(const T& s, const Dual& a) { return a.moved(s + a.value); }
  friend Dual operator-(const Dual& a, const T& s) { return a.moved(a.value - s); }
  friend Dual operator-(const T& s, const Dual& a) { return a.composed(s - a.value, constant<T>(-1)); }
  friend Dual operator*(const Dual& a, const T& s) { return a.composed(a.value * s, s); }
  friend Dual operator*(const T& s, const Dual& a) { return a.composed(s * a.value, s); }
  friend Dual operator/(const Dual& a, const T& s) { return a * (constant<T>(1) / s); }
  friend Dual operator/(const T& s, const Dual& a) {
    const T quotient = s / a.value;
    return a.composed(quotient, -quotient / a.value);
  }

  friend Dual sqrt(const Dual& a) {
    using std::sqrt;
    const T root = sqrt(a.value);
    return a.composed(root, constant<T>(0.5) / root);
  }
  friend Dual exp(const Dual& a) {
    using std::exp;
    const T power = exp(a.value);
    return a.composed(power, power);
  }
  friend Dual log(const Dual& a) {
    using std::log;
    return a.composed(log(a.value), constant<T>(1) / a.value);
  }
  friend Dual pow(const Dual& a, double exponent) {
    using std::pow;
    return a.composed(pow(a.value, exponent), constant<T>(exponent) * pow(a.value, exponent - 1));
  }
  friend Dual atan2(const Dual& y, const Dual& x) {
    using std::atan2;
    const T inverse = constant<T>(1) / (x.value * x.value + y.value * y.value);
    return combined(atan2(y.value, x.value), x.value * inverse, y, -y.value * inverse, x);
  }

 private:
  /// The same derivatives with another value.
  Dual moved(const T& other) const {
    Dual result = *this;
    result.value = other;
    return result;
  }
  /// A function of this number, by its value and its derivative.
  Dual composed(const T& of_value, const T& derivative) const {
    Dual result;
    result.value = of_value;
    for (std::size_t i = 0; i < packs.size(); ++i) result.packs[i] = packs[i] * derivative;
    return result;
  }
  /// A function of two numbers, by its value and both derivatives.
  static Dual combined(const T& of_values, const T& by_a, const Dual& a, const T& by_b, const Dual& b) {
    Dual result;
    result.value = of_values;
    for (std::size_t i = 0; i < a.packs.size(); ++i) result.packs[i] = a.packs[i] * by_a + b.packs[i] * by_b;
    return result;
  }
};

/// Numbers that all following is differentiated with respect to.
template <class T, std::size_t count>
std::array<Dual<T, int(count)>, count> independent(const std::array<T, count>& values) {
  std::array<Dual<T, int(count)>, count> numbers;
  for (std::size_t i = 0; i < count; ++i) numbers[i] = {values[i], int(i)};
  return numbers;
}

}  // namespace rheocyte
