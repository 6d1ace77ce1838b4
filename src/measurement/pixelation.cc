#include "measurement/pixelation.h"

#include <Eigen/Core>
#include <cassert>
#include <cmath>

namespace rheocyte {

namespace {

constexpr double fitted_pixel_um = 0.34;  // of the images from which the sums of exponentials were fitted

double pixel_ratio(double pixel_size_um) { return fitted_pixel_um / pixel_size_um; }

}  // namespace

double deformation_by_pixels_at_area(double area_um2, double pixel_size_um) {
  const double a = area_um2 * std::pow(pixel_ratio(pixel_size_um), 2);
  return 0.0012 + 0.020 * std::exp(-a / 7.1) + 0.010 * std::exp(-a / 38.6) + 0.005 * std::exp(-a / 296);
}

double deformation_by_pixels_at_volume(double volume_um3, double pixel_size_um) {
  const double v = volume_um3 * std::pow(pixel_ratio(pixel_size_um), 3);
  return 0.0013 + 0.0172 * std::exp(-v / 40) + 0.0070 * std::exp(-v / 450) + 0.0032 * std::exp(-v / 6040);
}

void remove_pixelation(std::span<const double> areas_um2, double pixel_size_um, std::span<double> deformations) {
  assert(areas_um2.size() == deformations.size());
  if (pixel_size_um == 0) return;
  const auto size = static_cast<Eigen::Index>(areas_um2.size());
  const Eigen::Map<const Eigen::ArrayXd> area(areas_um2.data(), size);
  Eigen::Map<Eigen::ArrayXd> deformation(deformations.data(), size);
  const double k = -std::pow(pixel_ratio(pixel_size_um), 2);
  deformation -=
      0.0012 + 0.020 * (k / 7.1 * area).exp() + 0.010 * (k / 38.6 * area).exp() + 0.005 * (k / 296 * area).exp();
}

}  // namespace rheocyte
