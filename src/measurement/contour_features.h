// Features of a cell's outline as the programs of RT-DC define them (docs/theory-extract.md, sec. "features").
#pragma once
#include <span>

#include "measurement/pixel_contour.h"
#include "measurement/pixel_hull.h"
#include "shape/polygon.h"

namespace rheocyte {

/// Of one outline; NaN where it has none. "Hull" is the convex hull of the outline, "raw" the outline itself; both run
/// through the centres of pixels.
struct ContourFeatures {
  double area_um2;                          ///< of the hull (feature area_um)
  double deformation;                       ///< 1 - 2 sqrt(pi A) / P of the hull (deform)
  double x_um, y_um;                        ///< centroid of the hull (pos_x, pos_y)
  double raw_area_px;                       ///< (area_msd)
  double area_ratio;                        ///< hull / raw
  double width_um, height_um;               ///< extent in whole pixels (size_x, size_y)
  double inertia_ratio, inertia_ratio_raw;  ///< sqrt(mu20 / mu02) (inert_ratio_cvx, inert_ratio_raw)
  double inertia_ratio_principal, tilt;     ///< of the outline itself along its principal axes (inert_ratio_prnc)
  double volume_um3;                        ///< mean of both halves rotated about the axis through the centroid
  double raw_perimeter_um;                  ///< (per_um_raw)
};

/// A feature of the shape by the name that the field's programs give it.
struct OutlineFeature {
  const char *name, *unit, *sentence;
  double (*value)(const ContourFeatures&);
};

/// All features of an outline, in the order of their names.
std::span<const OutlineFeature> outline_features();

/// Computes features; keeps its memory from contour to contour.
class ContourMeasurer {
 public:
  /// `pixel_size_um` > 0. Fewer than four points, or all on a line, give NaN everywhere.
  ContourFeatures measure(std::span<const PixelPoint> contour, double pixel_size_um);

  /// The hull alone, of one point at least. Valid until the next call.
  const Polygon& find_hull(std::span<const PixelPoint> contour);
  /// That of the outline that was measured last, if it has features.
  const Polygon& hull() const { return hull_polygon_; }

  /// Memory for contours of so many points over so many columns: measuring then takes no more.
  void reserve(std::size_t points, std::size_t columns) {
    hull_.reserve(columns);
    hull_polygon_.reserve(2 * columns + 1);
    polygon_.reserve(points);
  }

 private:
  PixelHull hull_;
  Polygon hull_polygon_, polygon_;
};

}  // namespace rheocyte
