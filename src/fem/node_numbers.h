// Numbers of points that elements of any dimension share: who means the same point gets the same number.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace rheocyte {

/// Row e lists the numbers of element e's nodes, first coordinate fastest.
struct NodeNumbers {
  int count = 0;
  std::vector<std::vector<int>> of_element;
};

/// Numbers points in the order in which they come; points nearer to each other than `tolerance` are one.
template <int dim>
class PointNumbers {
 public:
  using Point = Eigen::Matrix<double, dim, 1>;

  int number(const Point& x) {
    const Cell first = cell(x, 0);
    for (int corner = 0; corner < 1 << dim; ++corner) {
      const Cell other = cell(x, corner);
      if (corner > 0 && other == first) continue;
      if (const auto found = numbers_.find(other); found != numbers_.end()) return found->second;
    }
    const int number = count_++;
    numbers_.emplace(cell(x, nearest), number);
    return number;
  }
  int count() const { return count_; }

 private:
  static constexpr double tolerance = 1e-10, width = 1e-6;
  static constexpr int nearest = -1;
  using Cell = std::array<std::int64_t, dim>;

  struct Hash {
    std::size_t operator()(const Cell& cell) const {
      std::uint64_t hash = 0;
      for (const auto index : cell) hash = (hash ^ std::uint64_t(index)) * 0x9E3779B97F4A7C15u;
      return hash ^ (hash >> 32);
    }
  };

  /// The cell of a fine grid round the point, or round a corner of the box of tolerance about it: a point that equals
  /// another one may lie on the other side of a grid line. The grid is shifted, as many points have round coordinates.
  static Cell cell(const Point& x, int corner) {
    constexpr double shift = 0.3819660113 * width;
    Cell cell;
    for (int i = 0; i < dim; ++i) {
      const double off = corner == nearest ? 0 : corner >> i & 1 ? tolerance : -tolerance;
      cell[i] = std::int64_t(std::floor((x(i) + shift + off) / width));
    }
    return cell;
  }

  std::unordered_map<Cell, int, Hash> numbers_;
  int count_ = 0;
};

/// Numbers the nodes of elements; `point(element, node)` is where a node lies.
template <int dim, class NodePoint>
NodeNumbers number_nodes(int elements, int nodes_per_element, const NodePoint& point) {
  PointNumbers<dim> points;
  NodeNumbers numbers;
  for (int e = 0; e < elements; ++e) {
    auto& nodes = numbers.of_element.emplace_back();
    for (int k = 0; k < nodes_per_element; ++k) nodes.push_back(points.number(point(e, k)));
  }
  numbers.count = points.count();
  return numbers;
}

}  // namespace rheocyte
