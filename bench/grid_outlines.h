// Outlines of a table's cells from its grid, which keeps the modes of their hulls.
#pragma once
#include <Eigen/Core>
#include <array>
#include <fstream>
#include <iterator>
#include <string>

#include "shape/outline_shape.h"
#include "table/stiffness_grid.h"

namespace rheocyte {

inline GridContent grid_in(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return grid_from_bytes(std::string{std::istreambuf_iterator<char>(stream), {}}, file);
}

/// Polygon (um) of the cell with this area and deformation, without the modes beyond the grid's: its own area and
/// deformation are those of outline_shape.
inline Eigen::MatrixX2d outline_in(const ShapeGrid& shapes, double area_um2, double deformation) {
  constexpr int points = 360;
  std::array<double, mode_count> modes{};
  for (int k = first_radius_mode; k <= last_radius_mode; ++k)
    modes[std::size_t(k - min_mode)] = shapes.mode(k, std::log(area_um2), deformation);
  return outline_of_modes(modes, area_um2, points);
}

}  // namespace rheocyte
