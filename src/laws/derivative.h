// First derivatives of a scalar function by dual numbers, at arguments that may be dual numbers themselves.
#pragma once
#include <array>
#include <utility>

#include "laws/dual.h"

namespace rheocyte {

/// f(x) and df/dx for f: array of N numbers -> number.
template <class T, std::size_t N, class Function>
std::pair<T, std::array<T, N>> value_and_slopes(const Function& f, const std::array<T, N>& x) {
  const Dual<T, int(N)> value = f(independent(x));
  std::pair<T, std::array<T, N>> result{value.value, {}};
  for (std::size_t i = 0; i < N; ++i) result.second[i] = value.slope(int(i));
  return result;
}

}  // namespace rheocyte
