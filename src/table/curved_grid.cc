#include "table/curved_grid.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "numeric/lagrange.h"

namespace rheocyte {
namespace {

constexpr int slope_points = 5;

/// Derivatives at nodes, in units of their distance: of the polynomials through the five (or all) around each.
std::vector<double> node_slopes(std::span<const double> values) {
  const int n = static_cast<int>(values.size()), m = std::min(slope_points, n);
  std::vector<double> nodes(static_cast<std::size_t>(m)), all;
  std::iota(nodes.begin(), nodes.end(), 0);
  std::vector<std::vector<double>> weights;  // by the place among the nodes
  for (const double place : nodes) weights.push_back(lagrange_weights(nodes, place).slope);
  for (int i = 0; i < n; ++i) {
    const int first = std::clamp(i - m / 2, 0, n - m);
    const auto& own = weights[static_cast<std::size_t>(i - first)];
    all.push_back(std::inner_product(own.begin(), own.end(), values.begin() + first, 0.0));
  }
  return all;
}

/// Columns x rows: along the rows of each column, or across the columns of each row.
std::vector<double> slopes_by_row(std::span<const double> values, std::size_t rows) {
  std::vector<double> all;
  for (std::size_t first = 0; first < values.size(); first += rows) {
    const auto column = node_slopes(values.subspan(first, rows));
    all.insert(all.end(), column.begin(), column.end());
  }
  return all;
}

std::vector<double> slopes_by_column(std::span<const double> values, std::size_t rows) {
  const std::size_t columns = values.size() / rows;
  std::vector<double> all(values.size()), line(columns);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t c = 0; c < columns; ++c) line[c] = values[c * rows + row];
    const auto slope = node_slopes(line);
    for (std::size_t c = 0; c < columns; ++c) all[c * rows + row] = slope[c];
  }
  return all;
}

}  // namespace

CurvedGrid::CurvedGrid(std::span<const double> lower, std::span<const double> upper, int rows)
    : rows_(rows), lower_(edges(lower)), upper_(edges(upper)) {
  assert(lower.size() == upper.size() && columns() > 1 && rows > 1);
}

std::vector<CurvedGrid::Edge> CurvedGrid::edges(std::span<const double> values) {
  const auto slopes = node_slopes(values);
  std::vector<Edge> made;
  for (std::size_t c = 0; c < values.size(); ++c) made.push_back({values[c], slopes[c]});
  return made;
}

CurvedGrid::Field CurvedGrid::field(std::span<const double> values) const {
  const auto rows = static_cast<std::size_t>(rows_);
  assert(values.size() == rows * lower_.size());
  const auto by_row = slopes_by_row(values, rows), by_column = slopes_by_column(values, rows),
             by_both = slopes_by_column(by_row, rows);
  Field made;
  for (std::size_t i = 0; i < values.size(); ++i) made.push_back({{values[i], by_column[i], by_row[i], by_both[i]}});
  return made;
}

CurvedGrid::Answer CurvedGrid::answer(const Field& field, const Place& place) const {
  const Node *const a = &field[node(place)], *const b = a + rows_;
  const double in_row = place.height - place.row;
  const HermiteWeights up = hermite(in_row), up_change = hermite_slope(in_row), weight = hermite(place.fraction),
                       change = hermite_slope(place.fraction);
  const Packet in_a = along(up, a), in_b = along(up, b);
  const double by_row = across(weight, along(up_change, a), along(up_change, b));
  // At constant height the place among the rows changes with their ends.
  const double lower_change = edge(lower_, place.column, change), upper_change = edge(upper_, place.column, change);
  const double row_change =
      -rows_per_height(place) * (lower_change + place.height / (rows_ - 1) * (upper_change - lower_change));
  return {across(weight, in_a, in_b), across(change, in_a, in_b) + by_row * row_change,
          by_row * rows_per_height(place)};
}

}  // namespace rheocyte
