// The polynomial through some points of a range.
#pragma once
#include <cstddef>

namespace rheocyte {

/// Lagrange's polynomial through the members y(x) of all nodes, at a place.
template <class Range, class Member>
double lagrange_value(const Range& nodes, double at, Member x, Member y) {
  double sum = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    double weight = 1;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if (k != i) weight *= (at - nodes[k].*x) / (nodes[i].*x - nodes[k].*x);
    sum += weight * nodes[i].*y;
  }
  return sum;
}

}  // namespace rheocyte
