#include "synth/pixel_picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "measurement/mask_from_outline.h"

namespace rheocyte {

namespace {

// Shades and lengths (um) that resemble recordings.
constexpr double background = 165, camera_noise = 2.5, rim_depth = 75, rim_width = 0.45, halo_height = 22,
                 halo_distance = 0.9, halo_width = 0.5, inside_height = 12, wall_depth = 60, wall_width = 0.8,
                 beyond_wall = 25;
constexpr double reach_um = 2.6;  // beyond this distance from the outline nothing of it is seen

double bell(double t) { return std::exp(-t * t); }

double distance_to_piece(const Eigen::RowVector2d& point, const Eigen::RowVector2d& a, const Eigen::RowVector2d& b) {
  const Eigen::RowVector2d along = b - a;
  const double length2 = along.squaredNorm();
  const double fraction = length2 > 0 ? std::clamp((point - a).dot(along) / length2, 0.0, 1.0) : 0;
  return (point - a - fraction * along).norm();
}

// The distance (pixels) of the centres of pixels from the outline where it is less than `reach`, else `reach`.
std::vector<double> distances(const Eigen::MatrixX2d& outline, ImageSize size, double reach) {
  std::vector<double> field(size.pixels(), reach);
  const auto bound = [](double value, std::size_t end) {
    return static_cast<std::size_t>(std::clamp(value, 0.0, static_cast<double>(end)));
  };
  for (Eigen::Index i = 0; i < outline.rows(); ++i) {
    const Eigen::RowVector2d a = outline.row(i), b = outline.row((i + 1) % outline.rows());
    const Eigen::RowVector2d low = a.cwiseMin(b).array() - reach, high = a.cwiseMax(b).array() + reach;
    for (std::size_t y = bound(std::ceil(low.y()), size.height); y < bound(std::floor(high.y()) + 1, size.height); ++y)
      for (std::size_t x = bound(std::ceil(low.x()), size.width); x < bound(std::floor(high.x()) + 1, size.width);
           ++x) {
        double& best = field[y * size.width + x];
        best = std::min(best, distance_to_piece({static_cast<double>(x), static_cast<double>(y)}, a, b));
      }
  }
  return field;
}

double shade_of_scene(const Scene& scene, double row) {
  const double from_wall = std::abs(row - scene.axis_px) * scene.pixel_size_um - 0.5 * scene.channel_width_um;
  return background - wall_depth * bell(from_wall / wall_width) - (from_wall > 0 ? beyond_wall : 0);
}

double shade_of_cell(double distance_um, bool inside) {
  const double rim = -rim_depth * bell(distance_um / rim_width);
  return inside ? rim + inside_height : rim + halo_height * bell((distance_um - halo_distance) / halo_width);
}

}  // namespace

void draw_grey(const Eigen::MatrixX2d& outline, const Scene& scene, ImageSize size, CellRandom& random,
               std::span<std::uint8_t> image) {
  const double reach = reach_um / scene.pixel_size_um;
  const auto field = distances(outline, size, reach);
  std::vector<std::uint8_t> inside(size.pixels());
  fill_mask(outline, size, inside);
  for (std::size_t y = 0; y < size.height; ++y) {
    const double behind = shade_of_scene(scene, static_cast<double>(y));
    for (std::size_t x = 0; x < size.width; ++x) {
      const std::size_t i = y * size.width + x;
      double shade = behind + camera_noise * random.normal();
      if (field[i] < reach || inside[i]) shade += shade_of_cell(field[i] * scene.pixel_size_um, inside[i] != 0);
      image[i] = static_cast<std::uint8_t>(std::clamp(std::lround(shade), 0L, 255L));
    }
  }
}

}  // namespace rheocyte
