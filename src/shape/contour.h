// The meridian of a cell as a curve of polynomial pieces, and the closed contour that a camera sees.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace rheocyte {

/// One polynomial piece of a meridian: row i is the point (x, r) at the i-th Gauss-Lobatto node of [0, 1].
/// x is the axial coordinate (flow direction), r >= 0 the distance to the axis; p + 1 rows for degree p.
using CurvePiece = Eigen::MatrixX2d;

/// The meridian of an axisymmetric cell from its front pole (r = 0, largest x) to its rear pole (r = 0);
/// the last point of a piece is the first of the next. Any length unit.
struct Contour {
  std::vector<CurvePiece> pieces;
};

}  // namespace rheocyte
