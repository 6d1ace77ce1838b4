// What a camera makes of an outline: a picture in shades of grey.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "measurement/pixel_contour.h"
#include "numeric/cell_random.h"

namespace rheocyte {

/// What the picture shows besides the cell.
struct Scene {
  double pixel_size_um = 0;
  double axis_px = 0;           ///< row of the channel's axis
  double channel_width_um = 0;  ///< its walls are drawn
};

/// Bright field as in RT-DC: grey background, dark walls, the cell as a dark rim with a bright halo, noise of the
/// camera.
void draw_grey(const Eigen::MatrixX2d& outline_px, const Scene& scene, ImageSize size, CellRandom& random,
               std::span<std::uint8_t> image);

}  // namespace rheocyte
