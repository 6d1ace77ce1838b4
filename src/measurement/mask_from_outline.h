// The mask of pixels that a camera and a perfect segmentation make of an outline.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "measurement/pixel_contour.h"

namespace rheocyte {

/// Sets the pixels whose centres lie inside the closed polygon to 1, all others to 0. Coordinates in pixels, the centre
/// of the first pixel is (0, 0). False if the polygon reaches beyond the centres of the outermost pixels.
bool fill_mask(const Eigen::MatrixX2d& outline_px, ImageSize size, std::span<std::uint8_t> mask);

}  // namespace rheocyte
