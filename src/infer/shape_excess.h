// A measured shape against that of a table's cell.
#pragma once

namespace rheocyte {

/// A measured shape against that of the table's cell of the same area and deformation.
struct ShapeExcess {
  double expected = 0;  ///< inertia ratio of the table's cell
  double excess = 0;    ///< measured - expected inertia ratio
  double error = 0;     ///< its standard deviation by pixels
  double odd_fraction =
      0;  ///< fraction of the deformation that no ellipse of this inertia ratio has; NaN if there is none
  /// Whether no cell of the table can have such a shape.
  bool is_elongated() const;
};

}  // namespace rheocyte
