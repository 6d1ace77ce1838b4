#include "table/node_slopes.h"

#include <algorithm>
#include <numeric>

#include "numeric/lagrange.h"

namespace rheocyte {

namespace {

constexpr int slope_points = 5;

}  // namespace

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

}  // namespace rheocyte
