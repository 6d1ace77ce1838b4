// What errors of a segmentation add to those of the pixels, for the solids of a table (docs/theory-populations.md,
// eq:outline-errors).
#pragma once
#include "measurement/outline_noise.h"
#include "shape/outline_shape.h"
#include "table/elongated_table.h"

namespace rheocyte {

/// Fitted to pictures of cells of the table with and without the displacement, at the same places. Repeatable.
class OutlineErrors {
 public:
  /// `length`: of the recording's channel over the table's; all other lengths in um. Without noise nothing is rendered.
  OutlineErrors(const ElongatedTable& table, double length, double pixel_size_um, const OutlineNoise& noise);

  /// Bias and covariance that come on top of those of the pixels, for a smooth outline of this ln(area / um2) and these
  /// modes.
  ShapeErrors at(double log_area, double mode_2, double mode_3) const;

 private:
  static constexpr int terms = 10, numbers = feature_count * (1 + feature_count);
  using Terms = Eigen::Matrix<double, 1, terms>;
  Terms terms_at(double log_area, double mode_2, double mode_3) const;

  OutlineNoise noise_;
  Eigen::Matrix<double, terms, numbers> law_ = Eigen::Matrix<double, terms, numbers>::Zero();
};

}  // namespace rheocyte
