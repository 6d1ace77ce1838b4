#include "fem/sampled_fields.h"

#include <algorithm>
#include <cmath>

namespace rheocyte {

int sampling_divisions(int points, std::size_t quadrilaterals) {
  constexpr int least = 3, most = 12;
  return std::clamp(int(std::lround(std::sqrt(double(points) / double(quadrilaterals)))) - 1, least, most);
}

Eigen::MatrixXd sampling_grid(const Eigen::MatrixXd& basis) {
  const Eigen::Index points = basis.rows(), nodes = basis.cols();
  Eigen::MatrixXd grid(points * points, nodes * nodes);
  for (Eigen::Index k = 0; k < grid.rows(); ++k) {
    for (Eigen::Index l = 0; l < grid.cols(); ++l)
      grid(k, l) = basis(k % points, l % nodes) * basis(k / points, l / nodes);
  }
  return grid;
}

void add_grid_triangles(std::uint32_t first, int divisions, std::vector<std::uint32_t>& triangles) {
  const auto row = static_cast<std::uint32_t>(divisions + 1);
  for (std::uint32_t j = 0; j + 1 < row; ++j) {
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
      const std::uint32_t at = first + j * row + i;
      triangles.insert(triangles.end(), {at, at + 1, at + row + 1, at, at + row + 1, at + row});
    }
  }
}

}  // namespace rheocyte
