// What a table's cells look like, and whether measured ones have such shapes (docs/theory-extract.md, sec. "Shapes").
#pragma once
#include <optional>

#include "infer/modulus_map.h"
#include "infer/shape_excess.h"
#include "table/shape_grid.h"
#include "table/stiffness_grid.h"

namespace rheocyte {

struct SmoothEvents;

class ShapeMap {
 public:
  /// The grid must hold shapes (asserted), and its stiffness must be Young's modulus.
  explicit ShapeMap(const StiffnessGrid& grid);

  const TableOrigin& origin() const { return origin_; }
  /// Sign of c_3 of a cell that moves towards +x.
  double sign_of_asymmetry() const { return sign_; }

  /// Spans of one length; the excess is NaN where a number is missing, and outside the areas of the table. Cells that
  /// are deformed more than the table's softest count as these.
  void compare(const MeasuringConditions& conditions, const MeasuredEvents& events,
               std::span<const double> inertia_ratios, std::span<ShapeExcess> excesses) const;

  /// Inertia ratio of the table's cell, in the channel of the table.
  double inertia_ratio(double area_um2, double deformation) const;
  const ShapeGrid& shapes() const { return shapes_; }

 private:
  TableOrigin origin_;
  ShapeGrid shapes_;
  double sign_;
};

/// 1 - 2 sqrt(pi A) / P of an ellipse with this ratio of its axes.
double deformation_of_ellipse(double ratio);

/// What pixels do to the inertia ratio at random; on average they leave it alone.
double inertia_ratio_deviation(double area_um2, double pixel_size_um);

}  // namespace rheocyte
