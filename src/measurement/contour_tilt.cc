#include "measurement/contour_tilt.h"

#include <algorithm>

namespace rheocyte {

bool is_cut(std::span<const PixelPoint> contour, const ImageSize& picture) {
  const auto touches = [](std::int32_t place, std::size_t extent) {
    return place <= 0 || place + 1 >= static_cast<std::int32_t>(extent);
  };
  return picture.pixels() > 0 && std::ranges::any_of(contour, [&](const PixelPoint& point) {
           return touches(point.x, picture.width) || touches(point.y, picture.height);
         });
}

OutlineTilt contour_tilt(std::span<const PixelPoint> contour, const Polygon& hull, int direction,
                         const ImageSize& picture) {
  return contour_tilt(contour, hull, hull_asymmetry(hull).sine_modes, direction, picture);
}

OutlineTilt contour_tilt(std::span<const PixelPoint> contour, const Polygon& hull, const SineModes& along_x,
                         int direction, const ImageSize& picture) {
  constexpr std::size_t fewest_points = 20;
  if (contour.size() < fewest_points || hull.corners() < 3 || is_cut(contour, picture)) return {};
  return outline_tilt(hull, along_x, direction);
}

}  // namespace rheocyte
