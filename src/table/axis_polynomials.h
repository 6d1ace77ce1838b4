// Polynomials between the nodes of one coordinate, some of which count only in part.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "numeric/lagrange.h"
#include "table/cell_coordinates.h"

namespace rheocyte {

/// The interval of ascending nodes that holds x, or the nearest one.
inline int interval_of(std::span<const double> nodes, double x) {
  const auto above = std::ranges::upper_bound(nodes, x);
  return std::clamp(int(above - nodes.begin()) - 1, 0, std::max(int(nodes.size()) - 2, 0));
}

struct NodeWeight {
  int node = 0;
  CellFunction weight = {};
};

/// The polynomials through up to four nodes around a cell on one axis: the two next ones in any case, then as many on
/// both sides as there are, without gaps.
class AxisPolynomials {
  /// Where a dent appears, the hull's features bend at another deformation in each branch: higher degrees do worse.
  static constexpr int most_nodes = 4;
  static constexpr int most_beside = most_nodes - 2;  ///< on one side of the cell's interval

 public:
  /// The nodes must outlive it.
  AxisPolynomials(std::span<const double> nodes, const CellCoordinates& cell, int coordinate)
      : nodes_(nodes), place_(cell(coordinate)), coordinate_(coordinate), below_(interval_of(nodes, place_)) {
    if (nodes.size() == 1) {
      whole_.of(0) = {1};
      return;
    }
    grow(
        {below_, below_ + 2}, {1}, [](int) { return CellFunction{1}; }, whole_);
  }

  class Weights {
   public:
    const NodeWeight* begin() const { return all_.data(); }
    const NodeWeight* end() const { return all_.data() + count_; }
    CellFunction& of(int node) {
      NodeWeight* const last = all_.data() + count_;
      NodeWeight* const known = std::ranges::find(all_.data(), last, node, &NodeWeight::node);
      if (known == last) all_[std::size_t(count_++)].node = node;
      return known->weight;
    }

   private:
    std::array<NodeWeight, 2 + 2 * most_beside> all_;
    int count_ = 0;
  };

  /// Of a cell far from the ends of branches.
  std::size_t usual_nodes() const { return std::min(nodes_.size(), std::size_t(most_nodes)); }

  /// Weights of the nodes. `part_of` gives how much one that is not next to the cell counts, from 0 to 1; what it
  /// leaves belongs to the polynomial without it, so that the sum changes smoothly with the part. `parts` keeps the
  /// weights where some count in part.
  template <class Part>
  const Weights& weights(const Part& part_of, std::optional<Weights>& parts) const {
    const auto counts_wholly = [&](const NodeWeight& one) {
      return one.node == below_ || one.node == below_ + 1 || part_of(one.node).value >= 1;
    };
    if (std::ranges::all_of(whole_, counts_wholly)) return whole_;
    grow({below_, below_ + 2}, {1}, part_of, parts.emplace());
    return *parts;
  }

 private:
  struct Window {
    int first, end;
    bool goes_down = true, goes_up = true, is_next_down = true;
  };
  struct Polynomial {
    std::array<double, most_nodes> value, slope;
  };

  /// Splits the weight between the window with the next node and without it, until it is full.
  template <class Part>
  void grow(Window window, const CellFunction& weight, const Part& part_of, Weights& weights) const {
    window.goes_down = window.goes_down && window.first > 0;
    window.goes_up = window.goes_up && window.end < int(nodes_.size());
    if (window.end - window.first == most_nodes || !(window.goes_down || window.goes_up))
      return add(window, weight, weights);
    const bool down = window.goes_down && (window.is_next_down || !window.goes_up);
    window.is_next_down = !down;
    const CellFunction part = part_of(down ? window.first - 1 : window.end);
    if (part.value < 1) {
      Window without = window;
      (down ? without.goes_down : without.goes_up) = false;
      grow(without, weight * part.complement(), part_of, weights);
    }
    if (part.value > 0) {
      (down ? window.first : window.end) += down ? -1 : 1;
      grow(window, part.value < 1 ? weight * part : weight, part_of, weights);
    }
  }

  void add(const Window& window, const CellFunction& weight, Weights& weights) const;
  /// All weights that are asked for at a cell are sums of few polynomials.
  const Polynomial& through(int first, int end) const;

  std::span<const double> nodes_;
  double place_;
  int coordinate_, below_;
  mutable std::array<std::array<std::optional<Polynomial>, most_beside + 1>, most_beside + 1> known_;
  Weights whole_;  ///< where all nodes count wholly
};

}  // namespace rheocyte
