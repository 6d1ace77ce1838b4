#include "table/axis_polynomials.h"

namespace rheocyte {

const AxisPolynomials::Polynomial& AxisPolynomials::through(int first, int end) const {
  auto& known = known_[std::size_t(below_ - first)][std::size_t(std::max(end - below_ - 2, 0))];
  if (known) return *known;
  known.emplace();
  lagrange_weights(nodes_.subspan(std::size_t(first), std::size_t(end - first)), place_, known->value, known->slope);
  return *known;
}

void AxisPolynomials::add(const Window& window, const CellFunction& weight, Weights& weights) const {
  const Polynomial& polynomial = through(window.first, window.end);
  for (int node = window.first; node < window.end; ++node) {
    const auto i = std::size_t(node - window.first);
    CellFunction& sum = weights.of(node);
    sum.value += weight.value * polynomial.value[i];
    sum.gradient += polynomial.value[i] * weight.gradient;
    sum.gradient(coordinate_) += weight.value * polynomial.slope[i];
  }
}

}  // namespace rheocyte
