// What the square channel does to the shape of a stationary cell of the tube of equal pressure drop
// (docs/theory-extract.md, sec. "The square channel").
#pragma once
#include "shape/outline_shape.h"

namespace rheocyte {

/// A cell with bulk and cortex as it is seen in the square channel, without pixels.
struct CellInSquare {
  double radius = 0.6;  ///< of the circle of its area, over half the channel's width
  double mode_2 = 0, mode_3 = 0;
  double cortex_fraction = 0;  ///< of E + E2D / r0
  double cortex_tension = 0;   ///< over r0, as a fraction of E + E2D / r0
  double thinning = 0;         ///< exponent of the liquid in the tube less that of the liquid in the square
};

/// Of modes of single cells between the branches of the table: in the median 1e-4, in the mean square 3e-4
/// (studies/square_law.py).
inline constexpr double error_between_branches = 2e-4;
/// Of cells with other laws than neo-Hookean ones the law leaves this many times as much (docs/theory-extract.md).
inline constexpr double error_factor_of_other_laws = 6;

/// What is added to the features of the neo-Hookean cell with the same radius at rest, moduli and tensions in a
/// table of cells whose cortex has an energy per reference area, which are those of a tube and of a cortex that a
/// bending stiffness keeps smooth, and how well that is known. Beyond the cells to which the law was fitted the nearest
/// counts; modes beyond the seventh do not change.
ShapeErrors change_by_square(const CellInSquare& cell);
/// Only what is added.
ShapeVector mean_change_by_square(const CellInSquare& cell);

}  // namespace rheocyte
