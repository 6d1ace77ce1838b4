// The mask of pixels that a camera and a perfect segmentation make of an outline.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "measurement/pixel_contour.h"

namespace rheocyte {

/// Sets the pixels whose centres lie inside the closed polygon to 1, all others to 0. Coordinates in pixels, the centre
/// of the first pixel is (0, 0). False if the polygon reaches beyond the centres of the outermost pixels.
bool fill_mask(const Eigen::MatrixX2d& outline_px, ImageSize size, std::span<std::uint8_t> mask);

/// take(row, x) where an edge from a to b crosses rows of pixels, whose numbers are not negative. A point on a row
/// counts once.
template <class Take>
void for_crossings(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b, const Take& take) {
  const auto [lower, upper] = std::minmax({a.y(), b.y()});
  for (auto y = static_cast<std::size_t>(std::ceil(lower)); static_cast<double>(y) < upper; ++y)
    take(y, a.x() + (static_cast<double>(y) - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
}

}  // namespace rheocyte
