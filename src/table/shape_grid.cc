#include "table/shape_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "numeric/hermite.h"
#include "table/node_slopes.h"

namespace rheocyte {

namespace {

constexpr bool is_odd(int k) { return k % 2 == 1; }

}  // namespace

ShapeGrid::ShapeGrid(ShapeNodes nodes) : nodes_(std::move(nodes)) {
  lower_slope_ = node_slopes(nodes_.lower);
  upper_slope_ = node_slopes(nodes_.upper);
  std::vector<double> excess = nodes_.inertia_ratio;
  for (double& value : excess) value -= 1;
  inertia_ratio_ = field(excess, false);
  for (int k = first_radius_mode; k <= last_radius_mode; ++k) {
    const auto place = std::size_t(k - first_radius_mode);
    modes_[place] = field(nodes_.modes[place], is_odd(k));
  }
}

ShapeGrid::Field ShapeGrid::field(std::span<const double> values, bool odd) const {
  const auto rows = std::size_t(nodes_.rows), columns = std::size_t(nodes_.columns);
  assert(values.size() == rows * columns);
  std::vector<double> scaled(values.begin(), values.end());
  for (std::size_t c = 0; c < columns; ++c)
    for (std::size_t row = 0; row < rows; ++row) {
      const double share = double(row) / double(rows - 1);
      const double log_deformation = (1 - share) * nodes_.lower[c] + share * nodes_.upper[c];
      scaled[c * rows + row] *= std::exp((odd ? -0.5 : -1) * log_deformation);
    }
  const auto by_row = slopes_by_row(scaled, rows), by_column = slopes_by_column(scaled, rows),
             by_both = slopes_by_column(by_row, rows);
  Field made;
  for (std::size_t i = 0; i < scaled.size(); ++i) made.push_back({scaled[i], by_column[i], by_row[i], by_both[i]});
  return made;
}

ShapeGrid::Scaled ShapeGrid::scaled(const Field& field, double log_area, double deformation) const {
  const double last_column = nodes_.columns - 1, last_row = nodes_.rows - 1;
  const double place = std::clamp((log_area - nodes_.min_log_area) / nodes_.column_step, 0.0, last_column);
  if (std::isnan(place) || std::isnan(deformation)) return {std::nan(""), std::nan("")};
  const int column = std::min(int(place), nodes_.columns - 2);
  const HermiteWeights across = hermite(place - column);
  const auto c = std::size_t(column);
  const auto edge = [&](const std::vector<double>& value, const std::vector<double>& slope) {
    return across(value[c], value[c + 1], slope[c], slope[c + 1]);
  };
  const double lower = edge(nodes_.lower, lower_slope_), upper = edge(nodes_.upper, upper_slope_);
  const double height = std::clamp((std::log(deformation) - lower) / (upper - lower) * last_row, 0.0, last_row);
  const int row = std::min(int(height), nodes_.rows - 2);
  const HermiteWeights up = hermite(height - row);
  const Node *const a = &field[c * std::size_t(nodes_.rows) + std::size_t(row)], *const b = a + nodes_.rows;
  const auto along = [&](const Node* n) { return up(n[0].value, n[1].value, n[0].by_row, n[1].by_row); };
  const auto slope = [&](const Node* n) { return up(n[0].by_column, n[1].by_column, n[0].by_both, n[1].by_both); };
  return {across(along(a), along(b), slope(a), slope(b)), std::min(deformation, std::exp(upper))};
}

bool ShapeGrid::has_area(double log_area) const {
  const double place = (log_area - nodes_.min_log_area) / nodes_.column_step;
  return place >= 0 && place <= nodes_.columns - 1;
}

double ShapeGrid::inertia_ratio(double log_area, double deformation) const {
  if (deformation <= 0) return 1;
  const auto [value, near] = scaled(inertia_ratio_, log_area, deformation);
  return 1 + near * value;
}

double ShapeGrid::mode(int k, double log_area, double deformation) const {
  assert(k >= first_radius_mode && k <= last_radius_mode);
  if (deformation <= 0) return 0;
  const auto [value, near] = scaled(modes_[std::size_t(k - first_radius_mode)], log_area, deformation);
  return value * (is_odd(k) ? std::sqrt(near) : near);
}

std::array<double, mode_count> ShapeGrid::modes(double log_area, double deformation) const {
  std::array<double, mode_count> modes{};
  for (int k = first_radius_mode; k <= last_radius_mode; ++k)
    modes[std::size_t(k - min_mode)] = mode(k, log_area, deformation);
  return modes;
}

}  // namespace rheocyte
