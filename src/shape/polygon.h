// A closed polygon and its integrals.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace rheocyte {

/// Area, centroid and moments of a polygon without the sign of its orientation, and its length.
struct PolygonMoments {
  double area = 0, x = 0, y = 0;        ///< area and centroid; all 0 without area, moments too
  double mu20 = 0, mu11 = 0, mu02 = 0;  ///< about the centroid
  double perimeter = 0;
};

/// Corners in double precision. Keeps its memory from one polygon to the next.
class Polygon {
 public:
  /// So many edges lie one after the other at least, so that the processor computes them side by side; those behind the
  /// last corner have no length.
  static constexpr std::size_t block = 8;

  /// Pixels or vectors.
  template <class Corners>
  void assign(const Corners& corners);
  std::size_t corners() const { return corners_; }
  /// Memory for so many corners: assign() then takes no more.
  void reserve(std::size_t corners) {
    x_.reserve(corners + block + 1);
    y_.reserve(corners + block + 1);
  }
  PolygonMoments moments() const;
  /// Rotation about the line y = `y` through each of the halves, then the mean.
  double volume_of_rotation(double y) const;

  std::size_t edges() const { return x_.size() - 1; }  ///< whole blocks
  /// The first corner, from which the others are counted: no cancellation.
  const Eigen::Vector2d& origin() const { return origin_; }
  /// From the origin; edge i leads from i to i + 1.
  const double* x() const { return x_.data(); }
  const double* y() const { return y_.data(); }

 private:
  static Eigen::Vector2d vector_of(const Eigen::Vector2d& point) { return point; }
  template <class Pixel>
  static Eigen::Vector2d vector_of(const Pixel& point) {
    return {point.x, point.y};
  }

  std::size_t corners_ = 0;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  std::vector<double> x_ = {0}, y_ = {0};
};

template <class Corners>
void Polygon::assign(const Corners& corners) {
  corners_ = corners.size();
  origin_ = corners_ > 0 ? vector_of(corners[0]) : Eigen::Vector2d(0, 0);
  const std::size_t edges = (corners_ + block - 1) / block * block;
  x_.resize(edges + 1);
  y_.resize(edges + 1);
  for (std::size_t i = 0; i < corners_; ++i) {
    const Eigen::Vector2d corner = vector_of(corners[i]) - origin_;
    x_[i] = corner.x();
    y_[i] = corner.y();
  }
  for (std::size_t i = corners_; i <= edges; ++i) x_[i] = y_[i] = 0;
}

}  // namespace rheocyte
