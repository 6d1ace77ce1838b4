// The convex hull of a chain of pixels.
#pragma once
#include <span>
#include <vector>

#include "measurement/pixel_contour.h"

namespace rheocyte {

/// Finds hulls in as many steps as the chain has pixels; keeps its memory from chain to chain.
class PixelHull {
 public:
  /// Corners of the hull, without points on its edges, from the leftmost (of these the one with the least y) on,
  /// counterclockwise for y that counts upwards. `contour` has one point at least. Valid until the next call.
  std::span<const PixelPoint> of(std::span<const PixelPoint> contour);
  std::span<const PixelPoint> points() const { return points_; }  ///< the last ones

  /// Memory for chains over so many columns: of() then takes no more.
  void reserve(std::size_t columns) {
    columns_.reserve(columns);
    points_.reserve(2 * columns + 1);
  }

 private:
  struct Column {
    std::int32_t min_y, max_y;
  };
  std::vector<Column> columns_;
  std::vector<PixelPoint> points_;
};

}  // namespace rheocyte
