#include "table/axis_weights.h"

#include <algorithm>
#include <utility>

#include "numeric/lagrange.h"

namespace rheocyte {

namespace {

/// Where a dent appears, the hull's features bend at another deformation in each branch: higher degrees do worse.
constexpr int most_nodes = 4;

class Polynomials {
 public:
  Polynomials(std::span<const double> nodes, const CellCoordinates& cell, int coordinate,
              const std::function<CellFunction(int)>& part_of)
      : nodes_(nodes), place_(cell(coordinate)), coordinate_(coordinate), part_of_(part_of) {
    weights.reserve(2 * most_nodes);
  }

  struct Window {
    int first, end;
    bool goes_down = true, goes_up = true, is_next_down = true;
  };

  /// Splits the weight between the window with the next node and without it, until it is full.
  void grow(Window window, const CellFunction& weight) {
    window.goes_down = window.goes_down && window.first > 0;
    window.goes_up = window.goes_up && window.end < int(nodes_.size());
    if (window.end - window.first == most_nodes || !(window.goes_down || window.goes_up)) return add(window, weight);
    const bool down = window.goes_down && (window.is_next_down || !window.goes_up);
    window.is_next_down = !down;
    const CellFunction part = part_of_(down ? window.first - 1 : window.end);
    if (part.value < 1) {
      Window without = window;
      (down ? without.goes_down : without.goes_up) = false;
      grow(without, weight * part.complement());
    }
    if (part.value > 0) {
      (down ? window.first : window.end) += down ? -1 : 1;
      grow(window, part.value < 1 ? weight * part : weight);
    }
  }

  std::vector<NodeWeight> weights;

 private:
  void add(const Window& window, const CellFunction& weight) {
    const auto polynomial =
        lagrange_weights(nodes_.subspan(std::size_t(window.first), std::size_t(window.end - window.first)), place_);
    for (int node = window.first; node < window.end; ++node) {
      const auto i = std::size_t(node - window.first);
      const auto known = std::ranges::find(weights, node, &NodeWeight::node);
      CellFunction& sum = known == weights.end() ? weights.emplace_back(NodeWeight{node, {}}).weight : known->weight;
      sum.value += weight.value * polynomial.value[i];
      sum.gradient += polynomial.value[i] * weight.gradient;
      sum.gradient(coordinate_) += weight.value * polynomial.slope[i];
    }
  }

  std::span<const double> nodes_;
  double place_;
  int coordinate_;
  const std::function<CellFunction(int)>& part_of_;
};

}  // namespace

int interval_of(std::span<const double> nodes, double x) {
  const auto above = std::ranges::upper_bound(nodes, x);
  return std::clamp(int(above - nodes.begin()) - 1, 0, std::max(int(nodes.size()) - 2, 0));
}

std::vector<NodeWeight> axis_weights(std::span<const double> nodes, const CellCoordinates& cell, int coordinate,
                                     const std::function<CellFunction(int)>& part_of) {
  Polynomials polynomials(nodes, cell, coordinate, part_of);
  const int below = interval_of(nodes, cell(coordinate));
  polynomials.grow({below, std::min(below + 2, int(nodes.size()))}, {1, CellCoordinates::Zero()});
  return std::move(polynomials.weights);
}

}  // namespace rheocyte
