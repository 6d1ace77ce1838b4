#include "table/shape_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rheocyte {

ShapeGrid::ShapeGrid(ShapeNodes nodes) : nodes_(std::move(nodes)), grid_(nodes_.lower, nodes_.upper, nodes_.rows) {
  std::vector<double> excess = nodes_.inertia_ratio;
  for (double& value : excess) value -= 1;
  inertia_ratio_ = field(excess, 2);
  for (int k = first_radius_mode; k <= last_radius_mode; ++k) {
    const auto place = std::size_t(k - first_radius_mode);
    modes_[place] = field(nodes_.modes[place], order_of_mode(k));
  }
}

CurvedGrid::Field ShapeGrid::field(std::span<const double> values, int order) const {
  const auto rows = std::size_t(nodes_.rows), columns = std::size_t(nodes_.columns);
  assert(values.size() == rows * columns);
  std::vector<double> scaled(values.begin(), values.end());
  for (std::size_t c = 0; c < columns; ++c)
    for (std::size_t row = 0; row < rows; ++row) {
      const double fraction = double(row) / double(rows - 1);
      const double log_deformation = (1 - fraction) * nodes_.lower[c] + fraction * nodes_.upper[c];
      scaled[c * rows + row] *= std::exp(-order * log_deformation / 2);
    }
  return grid_.field(scaled);
}

ShapeGrid::Scaled ShapeGrid::scaled(const CurvedGrid::Field& field, double log_area, double deformation) const {
  const double last = nodes_.columns - 1;
  const double column = std::clamp((log_area - nodes_.min_log_area) / nodes_.column_step, 0.0, last);
  if (std::isnan(column) || std::isnan(deformation)) return {std::nan(""), std::nan("")};
  const int before = std::min(int(column), nodes_.columns - 2);
  CurvedGrid::Place place = grid_.between_columns(before, column - before);
  grid_.set_height(place, std::clamp(std::log(deformation), place.lower, place.upper));
  return {grid_.value(field, place), std::min(deformation, std::exp(place.upper))};
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
  return value * (order_of_mode(k) == 1 ? std::sqrt(near) : near);
}

std::array<double, mode_count> ShapeGrid::modes(double log_area, double deformation) const {
  std::array<double, mode_count> modes{};
  for (int k = first_radius_mode; k <= last_radius_mode; ++k)
    modes[std::size_t(k - min_mode)] = mode(k, log_area, deformation);
  return modes;
}

}  // namespace rheocyte
