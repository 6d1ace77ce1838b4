// What the cells of a table look like: inertia ratio and modes of the hull over area and deformation.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "shape/outline_shape.h"
#include "shape/radius_modes.h"
#include "table/curved_grid.h"

namespace rheocyte {

/// Nodes at equal distances in ln(area) and, in each column, at equal distances in ln(deformation). Columns x rows with
/// the rows of a column behind each other.
struct ShapeNodes {
  double min_log_area = 0, column_step = 0;  ///< ln(um^2)
  int columns = 0, rows = 0;
  std::vector<double> lower, upper;   ///< ln(deformation) of the first and the last row, by column
  std::vector<double> inertia_ratio;  ///< of the hull
  std::array<std::vector<double>, std::tuple_size_v<RadiusModes>> modes;  ///< c_2, c_3, ...
};

/// Bicubic (Hermite). Even modes and ir - 1 grow like the deformation, odd modes like its square root: what is left is
/// nearly constant, and so nodes can be far apart.
class ShapeGrid {
 public:
  explicit ShapeGrid(ShapeNodes nodes);

  const ShapeNodes& nodes() const { return nodes_; }

  /// Outside the table's areas and beyond the end of its states the nearest ones count; a deformation that is not
  /// positive belongs to a circle. NaN for NaN.
  double inertia_ratio(double log_area, double deformation) const;
  bool has_area(double log_area) const;
  /// c_k, first_radius_mode <= k <= last_radius_mode.
  double mode(int k, double log_area, double deformation) const;
  /// All of them, those beyond last_radius_mode 0.
  std::array<double, mode_count> modes(double log_area, double deformation) const;

 private:
  CurvedGrid::Field field(std::span<const double> values, int order) const;  ///< order_of_mode
  /// A field at the table's cell nearest to these, and the deformation of that.
  struct Scaled {
    double value, deformation;
  };
  Scaled scaled(const CurvedGrid::Field& field, double log_area, double deformation) const;

  ShapeNodes nodes_;
  CurvedGrid grid_;
  CurvedGrid::Field inertia_ratio_;
  std::array<CurvedGrid::Field, std::tuple_size_v<RadiusModes>> modes_;
};

}  // namespace rheocyte
