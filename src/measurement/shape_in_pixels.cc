#include "measurement/shape_in_pixels.h"

#include <algorithm>
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

namespace {

/// A picture with a margin around an outline, and the outline in pixels about its own middle.
struct Framed {
  ImageSize size;
  Eigen::MatrixX2d centred_px;

  Framed(const Eigen::MatrixX2d& outline_um, double pixel_size_um) {
    constexpr double margin = 3;
    const Eigen::RowVector2d low = outline_um.colwise().minCoeff(), high = outline_um.colwise().maxCoeff();
    const Eigen::RowVector2d extent = (high - low) / pixel_size_um;
    size = {std::size_t(std::ceil(extent.x() + 2 * margin)) | 1U, std::size_t(std::ceil(extent.y() + 2 * margin)) | 1U};
    centred_px = (outline_um.rowwise() - (low + high) / 2) / pixel_size_um;
  }
};

Eigen::RowVector2d middle_of(const ImageSize& size) {
  return {(double(size.width) - 1) / 2, (double(size.height) - 1) / 2};
}

}  // namespace

ShapeVector features_in_pixels(const Eigen::MatrixX2d& outline_um, double pixel_size_um,
                               const Eigen::RowVector2d& place_px) {
  const Framed framed(outline_um, pixel_size_um);
  const Eigen::MatrixX2d outline_px = framed.centred_px.rowwise() + (middle_of(framed.size) + place_px);
  std::vector<std::uint8_t> mask(framed.size.pixels());
  const bool is_whole = fill_mask(outline_px, framed.size, mask);
  assert(is_whole);
  static_cast<void>(is_whole);
  ContourFinder finder;
  return shape_of_contour(finder.contour_of({framed.size, mask}), pixel_size_um);
}

FigureInPixels::FigureInPixels(const Eigen::MatrixX2d& outline_um, double pixel_size_um)
    : outline_um_(outline_um), pixel_size_um_(pixel_size_um) {
  const Framed framed(outline_um, pixel_size_um);
  size_ = framed.size;
  centred_px_ = framed.centred_px.transpose();
  rows_.resize(size_.height);
  measurer_.reserve(0, size_.width);
}

bool FigureInPixels::find_ends(const Eigen::RowVector2d& place_px) {
  std::ranges::fill(rows_, Row{});
  const auto take = [&](std::size_t y, double x) {
    Row& row = rows_[y];
    if (row.crossings++ == 0) {
      row.first = row.last = x;
    } else {
      row.first = std::min(row.first, x);
      row.last = std::max(row.last, x);
    }
  };
  const Eigen::RowVector2d shift = middle_of(size_) + place_px;
  const auto point = [&](Eigen::Index i) { return Eigen::RowVector2d(centred_px_.col(i).transpose() + shift); };
  Eigen::RowVector2d before = point(centred_px_.cols() - 1);
  for (Eigen::Index i = 0; i < centred_px_.cols(); ++i) {
    const Eigen::RowVector2d here = point(i);
    for_crossings(before, here, take);
    before = here;
  }
  ends_.clear();
  for (std::size_t y = 0; y < rows_.size(); ++y) {
    const Row& row = rows_[y];
    if (row.crossings == 0) continue;
    const PixelPoint first{std::int32_t(std::ceil(row.first)), std::int32_t(y)},
        last{std::int32_t(std::floor(row.last)), first.y};
    if (row.crossings > 2) return false;
    if (first.x > last.x) continue;  // narrower than a pixel
    if (!ends_.empty()) {
      const PixelPoint &first_above = ends_[ends_.size() - 2], &last_above = ends_.back();
      if (last_above.y + 1 != first.y || first.x > last_above.x + 1 || last.x < first_above.x - 1) return false;
    }
    ends_.push_back(first);
    ends_.push_back(last);
  }
  return !ends_.empty();
}

Eigen::Vector3d FigureInPixels::at(const Eigen::RowVector2d& place_px) {
  if (!find_ends(place_px)) return features_in_pixels(outline_um_, pixel_size_um_, place_px).head<3>();
  const OutlineShape figure = hull_figure(measurer_.find_hull(ends_));
  return {std::log(figure.area * (pixel_size_um_ * pixel_size_um_)), figure.deformation, figure.moment_ratio};
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
