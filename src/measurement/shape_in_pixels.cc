#include "measurement/shape_in_pixels.h"

#include <cassert>
#include <cmath>
#include <cstdint>
#include <vector>

#include "measurement/contour_features.h"
#include "measurement/contour_from_mask.h"
#include "measurement/mask_from_outline.h"

namespace rheocyte {

ShapeVector shape_of_contour(const PixelContour& contour, double pixel_size_um) {
  ContourMeasurer measurer;
  OutlineShape shape = hull_shape(measurer.find_hull(contour));
  shape.area *= pixel_size_um * pixel_size_um;
  return shape_vector(shape);
}

ShapeVector features_in_pixels(const Eigen::MatrixX2d& outline_um, double pixel_size_um,
                               const Eigen::RowVector2d& place_px) {
  const Eigen::RowVector2d low = outline_um.colwise().minCoeff(), high = outline_um.colwise().maxCoeff();
  const Eigen::RowVector2d extent = (high - low) / pixel_size_um;
  constexpr double margin = 3;
  const ImageSize size{std::size_t(std::ceil(extent.x() + 2 * margin)) | 1U,
                       std::size_t(std::ceil(extent.y() + 2 * margin)) | 1U};
  const Eigen::RowVector2d middle((double(size.width) - 1) / 2, (double(size.height) - 1) / 2);
  const Eigen::MatrixX2d outline_px =
      (outline_um.rowwise() - (low + high) / 2) / pixel_size_um + (middle + place_px).replicate(outline_um.rows(), 1);
  std::vector<std::uint8_t> mask(size.pixels());
  const bool is_whole = fill_mask(outline_px, size, mask);
  assert(is_whole);
  static_cast<void>(is_whole);
  ContourFinder finder;
  return shape_of_contour(finder.contour_of({size, mask}), pixel_size_um);
}

namespace {

ShapeErrors errors_to_one_side(const Eigen::MatrixX2d& outline_um, double pixel_size_um, int draws, CellRandom& random,
                               const OutlineNoise& noise_um) {
  assert(draws > 1);
  const ShapeVector truth = shape_vector(outline_shape(outline_um));
  const double height = outline_um.col(1).maxCoeff() - outline_um.col(1).minCoeff();
  Eigen::Matrix3Xd numbers(3, draws);  // before those of the noise, so that places are the same with it and without
  for (double& number : numbers.reshaped()) number = random.uniform() - 0.5;
  ShapeErrors errors;
  for (const auto& place : numbers.colwise()) {
    const double size = 1 + place(2) * pixel_size_um / height;
    ShapeVector error =
        features_in_pixels(displaced(size * outline_um, noise_um, random), pixel_size_um, {place(0), place(1)}) - truth;
    error(int(ShapeFeature::area_um2)) -= 2 * std::log(size);
    errors.bias += error / draws;
    errors.covariance += error * error.transpose() / (draws - 1);
  }
  errors.covariance -= errors.bias * errors.bias.transpose() * (double(draws) / (draws - 1));
  return errors;
}

}  // namespace

ShapeErrors errors_in_pixels(const Eigen::MatrixX2d& outline_um, double pixel_size_um, int draws, CellRandom& random,
                             const OutlineNoise& noise_um) {
  if (noise_um.deviation == 0) return errors_to_one_side(outline_um, pixel_size_um, draws, random, noise_um);
  CellRandom again = random;
  const OutlineNoise opposite{-noise_um.deviation, noise_um.correlation};
  const ShapeErrors out = errors_to_one_side(outline_um, pixel_size_um, draws / 2, random, noise_um),
                    in = errors_to_one_side(outline_um, pixel_size_um, draws / 2, again, opposite);
  return {(out.bias + in.bias) / 2, (out.covariance + in.covariance) / 2};
}

}  // namespace rheocyte
