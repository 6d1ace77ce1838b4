// Isoelasticity lines over area and deformation, from the analytical model for solid cells.
#pragma once
#include <vector>

#include "analytic/small_deformation.h"

namespace rheocyte {

/// Which lines are requested, and where they have points.
struct IsoelasticityGrid {
  std::vector<double> radii;              ///< r0 / R, ascending
  std::vector<double> capillary_numbers;  ///< eta Q / (R^3 E), one line for each
  double max_deformation = max_solid_deformation;
  Duct duct = Duct::tube;
};

struct IsoelasticityPoint {
  double radius = 0;       ///< r0 / R
  double area = 0;         ///< of the convexified contour, in R^2
  double deformation = 0;  ///< of the convexified contour
};

/// One line for each capillary number, its points by growing radius. A line that leaves the allowed deformations
/// between two radii ends with a point at the greatest allowed one; a line whose first point is not allowed is empty.
std::vector<std::vector<IsoelasticityPoint>> isoelasticity_lines(const IsoelasticityGrid&);

}  // namespace rheocyte
