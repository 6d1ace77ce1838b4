// The polynomial through some points, and good points for it.
#pragma once
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace rheocyte {

/// Of the values at the nodes in the polynomial and in its derivative.
struct LagrangeWeights {
  std::vector<double> value, slope;
};

/// Extrema of Chebyshev's polynomial with both ends, ascending: nodes for polynomials over [first, last].
inline std::vector<double> chebyshev_points(double first, double last, int count) {
  std::vector<double> points;
  for (int i = 0; i < count; ++i)
    points.push_back((first + last) / 2 - (last - first) / 2 * std::cos(std::numbers::pi * i / (count - 1)));
  points.front() = first;
  points.back() = last;
  return points;
}

/// The same, written to spans as long as the nodes.
inline void lagrange_weights(std::span<const double> nodes, double x, std::span<double> value,
                             std::span<double> slope) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    value[i] = 1, slope[i] = 0;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (k == i) continue;
      const double factor = 1 / (nodes[i] - nodes[k]);
      slope[i] = slope[i] * (x - nodes[k]) * factor + value[i] * factor;
      value[i] *= (x - nodes[k]) * factor;
    }
  }
}

inline LagrangeWeights lagrange_weights(std::span<const double> nodes, double x) {
  LagrangeWeights weights{std::vector<double>(nodes.size()), std::vector<double>(nodes.size())};
  lagrange_weights(nodes, x, weights.value, weights.slope);
  return weights;
}

/// The polynomial through the members y(x) of all nodes, at a place.
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

/// A polynomial and how far it can be trusted.
struct PolynomialEstimate {
  double value;
  double change;  ///< value - that of the polynomial of two degrees less, through the nodes in the middle
};

/// At least two nodes (of three, the first two count as those in the middle).
template <class Node, class Member>
PolynomialEstimate lagrange_estimate(std::span<const Node> nodes, double at, Member x, Member y) {
  const auto inner = nodes.size() > 3 ? nodes.subspan(1, nodes.size() - 2) : nodes.first(2);
  const double value = lagrange_value(nodes, at, x, y);
  return {value, value - lagrange_value(inner, at, x, y)};
}

}  // namespace rheocyte
