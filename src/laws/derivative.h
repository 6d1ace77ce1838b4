// First derivatives of a scalar function by dual numbers, at arguments that may be dual numbers themselves.
#pragma once
#include <ceres/jet.h>

#include <array>
#include <utility>

namespace rheocyte {

/// f(x) and df/dx for f: array of N numbers -> number.
template <int N, class T, class Function>
std::pair<T, std::array<T, N>> value_and_slopes(const Function& f, const std::array<T, N>& x) {
  using Dual = ceres::Jet<T, N>;
  std::array<Dual, N> dual;
  for (int i = 0; i < N; ++i) dual[i] = Dual(x[i], i);
  const Dual value = f(dual);
  std::pair<T, std::array<T, N>> result{value.a, {}};
  for (int i = 0; i < N; ++i) result.second[i] = value.v(i);
  return result;
}

}  // namespace rheocyte
