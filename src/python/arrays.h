// Numbers between C++ and numpy.
#pragma once
#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <span>
#include <utility>
#include <vector>

namespace rheocyte {

/// Contiguous 64-bit numbers of a numpy array, which stays as it is; anything else is refused by pybind11 and was
/// converted by the caller (python/rheocyte/arrays.py).
using Numbers = pybind11::array_t<double, pybind11::array::c_style>;

inline std::span<const double> span_of(const Numbers& numbers) {
  return {numbers.data(), static_cast<std::size_t>(numbers.size())};
}

/// Where the numbers of an array that is ours are written.
template <class Number>
std::span<Number> span_to_fill(pybind11::array_t<Number>& array) {
  return {array.mutable_data(), static_cast<std::size_t>(array.size())};
}

/// The array takes the numbers over; nothing is copied.
template <class Number>
pybind11::array_t<Number> array_of(std::vector<Number>&& numbers) {
  auto* const owned = new std::vector<Number>(std::move(numbers));
  const pybind11::capsule owner(owned, [](void* kept) { delete static_cast<std::vector<Number>*>(kept); });
  return pybind11::array_t<Number>(static_cast<pybind11::ssize_t>(owned->size()), owned->data(), owner);
}

/// Points as rows of an array (n, 2).
template <class Points>
pybind11::array_t<double> array_of_points(const Points& points, double Points::value_type::*x,
                                          double Points::value_type::*y) {
  pybind11::array_t<double> array({static_cast<pybind11::ssize_t>(points.size()), pybind11::ssize_t{2}});
  auto rows = array.template mutable_unchecked<2>();
  pybind11::ssize_t row = 0;
  for (const auto& point : points) {
    rows(row, 0) = point.*x;
    rows(row, 1) = point.*y;
    ++row;
  }
  return array;
}

inline pybind11::array_t<double> array_of_points(const Eigen::MatrixX2d& points) {
  pybind11::array_t<double> array({static_cast<pybind11::ssize_t>(points.rows()), pybind11::ssize_t{2}});
  auto rows = array.mutable_unchecked<2>();
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    for (int c = 0; c < 2; ++c) rows(i, c) = points(i, c);
  return array;
}

}  // namespace rheocyte
