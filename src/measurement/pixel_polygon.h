// The polygon through the centres of a closed chain of pixels, and its integrals.
#pragma once
#include <span>
#include <vector>

#include "measurement/pixel_contour.h"

namespace rheocyte {

/// Area, centroid and moments of a polygon without the sign of its orientation, and its length; in pixels.
struct PolygonMoments {
  double area = 0, x = 0, y = 0;        ///< area and centroid; all 0 without area, moments too
  double mu20 = 0, mu11 = 0, mu02 = 0;  ///< about the centroid
  double perimeter = 0;
};

/// Corners in double precision. Keeps its memory from chain to chain.
class PixelPolygon {
 public:
  void assign(std::span<const PixelPoint> chain);  ///< at least one point
  PolygonMoments moments() const;
  /// Rotation about the line y = `y` through each of the halves, then the mean (pixels cubed).
  double volume_of_rotation(double y) const;

 private:
  PixelPoint origin_;          // the first corner
  std::size_t edges_ = 0;      // whole blocks: those behind the last corner have no length
  std::vector<double> x_, y_;  // from the origin: no cancellation; one more than edges
};

}  // namespace rheocyte
