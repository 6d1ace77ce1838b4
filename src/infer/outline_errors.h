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
  /// Of cells in a channel of this width; lengths in um. Without noise nothing is rendered.
  OutlineErrors(const ElongatedTable& table, double width_um, double pixel_size_um, const OutlineNoise& noise);

  /// Bias and covariance that come on top of those of the pixels, for a smooth outline of this ln(area / um2) and these
  /// modes.
  ShapeErrors at(double log_area, double mode_2, double mode_3) const;

 private:
  /// Of all polynomials of the third degree; those of the second stand first.
  static constexpr int degree = 3, term_count = 20, terms_of_second_degree = 10,
                       covariances = feature_count * feature_count;
  using Terms = Eigen::Matrix<double, 1, term_count>;
  Terms terms_at(double log_area, double mode_2, double mode_3) const;
  /// By which polynomials are multiplied: variances are as the part of the outline that is off alike.
  struct Scales {
    double bias, covariance;
  };
  Scales scales_at(double log_area) const;

  OutlineNoise noise_;
  Eigen::Matrix<double, term_count, feature_count> bias_ = Eigen::Matrix<double, term_count, feature_count>::Zero();
  Eigen::Matrix<double, terms_of_second_degree, covariances> covariance_ =
      Eigen::Matrix<double, terms_of_second_degree, covariances>::Zero();
};

}  // namespace rheocyte
