// What pixels do to the features of a shape: mean and covariance over all positions of the cell on the camera.
#pragma once
#include <vector>

#include "measurement/contour_features.h"
#include "measurement/outline_noise.h"
#include "measurement/pixel_contour.h"
#include "numeric/cell_random.h"
#include "shape/outline_shape.h"

namespace rheocyte {

/// Features of the polygon through the centres of a contour's pixels.
ShapeVector shape_of_contour(const PixelContour& contour, double pixel_size_um);

/// Renders the outline (um, x along the flow) at `draws` random positions, as fill_mask does, and measures each mask's
/// contour. Sizes are spread over one pixel of the height, because a cell that is a whole number of pixels high counts
/// as many rows nearly wherever it lies, and its errors are those of no other cell. The covariance is that of one
/// picture. With errors of a segmentation each of half as many places, the same as without, has one of its own and its
/// opposite, so that the mean of a few pictures has nothing of the first order.
ShapeErrors errors_in_pixels(const Eigen::MatrixX2d& outline_um, double pixel_size_um, int draws, CellRandom& random,
                             const OutlineNoise& noise_um = {});

/// Features of the outline in one picture with the cell's middle at `place_px` from the middle of a pixel.
ShapeVector features_in_pixels(const Eigen::MatrixX2d& outline_um, double pixel_size_um,
                               const Eigen::RowVector2d& place_px);

/// ln(area / um2), deformation and Lambda1 / Lambda2 of one outline at many places: the same numbers, several times as
/// fast, by the first and the last pixel of each row.
class FigureInPixels {
 public:
  FigureInPixels(const Eigen::MatrixX2d& outline_um, double pixel_size_um);
  Eigen::Vector3d at(const Eigen::RowVector2d& place_px);

 private:
  struct Row {
    double first = 0, last = 0;  ///< crossings
    int crossings = 0;
  };
  /// Sets the ends of the rows; whether they are all of the mask: one piece, and one stretch of pixels in each row.
  bool find_ends(const Eigen::RowVector2d& place_px);

  const Eigen::MatrixX2d outline_um_;
  double pixel_size_um_;
  ImageSize size_;
  Eigen::Matrix2Xd centred_px_;
  std::vector<Row> rows_;
  PixelContour ends_;
  ContourMeasurer measurer_;
};

}  // namespace rheocyte
