// How the outline of a cell in a picture lies to the flow.
#pragma once
#include <span>

#include "measurement/pixel_contour.h"
#include "shape/outline_shape.h"

namespace rheocyte {

/// Whether an outline touches the border of its picture, as that of a cell which lies half outside does; false where
/// the size of the picture is unknown (0 x 0).
bool is_cut(std::span<const PixelPoint> contour, const ImageSize& picture);

/// Of an outline with its hull, as outline_tilt(); NaN where it is cut or has fewer than 20 points. The second form
/// takes the sine modes that are known already.
OutlineTilt contour_tilt(std::span<const PixelPoint> contour, const Polygon& hull, int direction,
                         const ImageSize& picture);
OutlineTilt contour_tilt(std::span<const PixelPoint> contour, const Polygon& hull, const SineModes& along_x,
                         int direction, const ImageSize& picture);

}  // namespace rheocyte
