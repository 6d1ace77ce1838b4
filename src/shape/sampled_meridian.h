// A meridian with dense samples: the common ground of validity checks, convex hull and curvature signs.
#pragma once
#include <optional>
#include <vector>

#include "shape/contour.h"

namespace rheocyte {

/// Points of a meridian on a uniform grid of its global parameter s = index of the piece + parameter in the piece.
class SampledMeridian {
 public:
  static constexpr int samples_per_piece = 48;

  /// Nothing if the contour has no inside: no pieces, a degree outside 1..12, numbers that are not finite, gaps,
  /// poles away from the axis or in the wrong order, r < 0, or a meridian that crosses itself.
  static std::optional<SampledMeridian> of(const Contour& contour);

  const std::vector<CurvePiece>& pieces() const { return pieces_; }
  /// One row (x, r) per sample, from the front pole to the rear pole.
  const Eigen::MatrixX2d& points() const { return points_; }
  int last_sample() const { return static_cast<int>(points_.rows()) - 1; }
  static double parameter(int sample) { return static_cast<double>(sample) / samples_per_piece; }
  double last_parameter() const { return static_cast<double>(pieces_.size()); }
  /// Largest extent along the axis or across it; the scale of every tolerance.
  double size() const { return size_; }

  /// The point (x, r) at a global parameter in [0, last_parameter()].
  Eigen::Vector2d point(double s) const;

 private:
  SampledMeridian() = default;
  bool has_inside() const;

  std::vector<CurvePiece> pieces_;
  Eigen::MatrixX2d points_;
  double size_ = 0;
};

}  // namespace rheocyte
