// Numbers over the part of a plane between two curves: a grid whose first and last rows follow them.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "numeric/hermite.h"
#include "numeric/whole_packets.h"

namespace rheocyte {

/// Columns at equal distances, and in each rows at equal distances between its ends. Bicubic (Hermite) with slopes from
/// the polynomials through five nodes.
class CurvedGrid {
 public:
  struct alignas(32) Node {
    std::array<double, 4> values;  ///< value, its slopes by the column and by the row, and by both
  };
  using Field = std::vector<Node>;

  /// Between two nodes each way.
  struct Place {
    int column = 0;               ///< the one before it
    double fraction = 0;          ///< of the way to the next one
    double lower = 0, upper = 0;  ///< ends of the rows there
    int row = 0;                  ///< the one below it
    double height = 0;            ///< in rows
  };

  struct Answer {
    double value, by_column, by_height;  ///< the derivatives at constant height (not row) and at constant column
  };

  /// The ends of each column; at least two columns and two rows.
  CurvedGrid(std::span<const double> lower, std::span<const double> upper, int rows);

  int columns() const { return static_cast<int>(lower_.size()); }
  int rows() const { return rows_; }
  /// Of columns x rows values, with the rows of a column behind each other.
  Field field(std::span<const double> values) const;

  /// Between a column and the next one; the height is not set yet.
  Place between_columns(int column, double fraction) const {
    const HermiteWeights weight = hermite(fraction);
    return {.column = column,
            .fraction = fraction,
            .lower = edge(lower_, column, weight),
            .upper = edge(upper_, column, weight)};
  }
  /// `height` from lower to upper.
  void set_height(Place& place, double height) const {
    place.height = (height - place.lower) * rows_per_height(place);
    place.row = std::min(static_cast<int>(place.height), rows_ - 2);
  }

  /// The first of the four nodes around a place; the others are the next one, and those of the next column.
  std::size_t node(const Place& place) const { return static_cast<std::size_t>(place.column * rows_ + place.row); }
  double value(const Field& field, const Place& place) const {
    const Node *const a = &field[node(place)], *const b = a + rows_;
    const HermiteWeights up = hermite(place.height - place.row);
    return across(hermite(place.fraction), along(up, a), along(up, b));
  }
  Answer answer(const Field& field, const Place& place) const;

 private:
  struct Edge {
    double value, by_column;
  };

  static std::vector<Edge> edges(std::span<const double> values);
  static double edge(const std::vector<Edge>& edges, int column, const HermiteWeights& weight) {
    const Edge &a = edges[static_cast<std::size_t>(column)], &b = edges[static_cast<std::size_t>(column) + 1];
    return weight(a.value, b.value, a.by_column, b.by_column);
  }
  double rows_per_height(const Place& place) const { return (rows_ - 1) / (place.upper - place.lower); }

  /// Of a node's value and slopes, by the place among the rows and among the columns.
  static Packet along(const HermiteWeights& up, const Node* node) {
    using Values = Eigen::Map<const Packet, Eigen::Aligned32>;
    const auto weights = [](double value, double slope) { return Packet{value, value, slope, slope}; };
    return weights(up.first, up.first_slope) * Values(node[0].values.data()) +
           weights(up.last, up.last_slope) * Values(node[1].values.data());
  }
  static double across(const HermiteWeights& weight, const Packet& in_a, const Packet& in_b) {
    const auto weights = [](double value, double slope) { return Packet{value, slope, value, slope}; };
    return (weights(weight.first, weight.first_slope) * in_a + weights(weight.last, weight.last_slope) * in_b).sum();
  }

  int rows_;
  std::vector<Edge> lower_, upper_;
};

}  // namespace rheocyte
