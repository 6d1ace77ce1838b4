// Dual numbers against central differences.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "laws/fields.h"

namespace rheocyte::test {

/// Step of the central differences: their error is h^2/6 times third derivatives of order 10 plus rounding 1e-16/h,
/// both near 1e-9, so the promised 1e-7 leaves room and any wrong term stands out.
inline constexpr double difference_step = 1e-5;
inline constexpr double derivative_tolerance = 1e-7;

/// Largest difference between the exact derivatives of `law` (a function of `N` numbers that returns an array) and
/// central differences, relative to the largest derivative where that is above 1.
template <std::size_t N, class Law>
double derivative_error(const Law& law, const std::array<double, N>& at) {
  const auto dual = law(independent(at));
  double error = 0, largest = 1;
  for (std::size_t i = 0; i < N; ++i) {
    auto above = at, below = at;
    above[i] += difference_step;
    below[i] -= difference_step;
    const auto plus = law(above), minus = law(below);
    for (std::size_t k = 0; k < plus.size(); ++k) {
      error = std::max(error, std::abs(dual[k].slope(int(i)) - (plus[k] - minus[k]) / (2 * difference_step)));
      largest = std::max(largest, std::abs(dual[k].slope(int(i))));
    }
  }
  return error / largest;
}

template <class T>
const T& last(const T& number) {
  return number;
}
template <class T>
const T& last(const Input&, const T& number) {
  return number;
}

/// A form from fields to fluxes as a function of arrays of their numbers; `Fields<T>` are those of the form.
template <template <class> class Fields, class Form>
auto numberwise(const Form& form) {
  return [form](const auto& numbers) {
    using T = std::decay_t<decltype(numbers[0])>;
    auto flux = form(read_fields<Fields<T>>([&](int i) { return numbers[i]; }));
    std::array<T, decltype(flux)::count> result;
    int k = 0;
    flux.visit([&](const auto&... number) { result[k++] = last(number...); });
    return result;
  };
}

/// A law from tensor to tensor as a function of arrays of its nine entries.
template <class TensorLaw>
auto entrywise(const TensorLaw& law) {
  return [law](const auto& entries) {
    using T = std::decay_t<decltype(entries[0])>;
    return law(Tensor<T>{entries}).entries;
  };
}

}  // namespace rheocyte::test
