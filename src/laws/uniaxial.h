// A neo-Hookean sphere that an even stress along an axis elongates.
#pragma once
#include <cmath>

namespace rheocyte {

/// Stretch l along the axis under a tension that is this fraction of Young's modulus: mu (l^2 - 1 / l) = T with mu = E
/// / 3; l^(-1/2) across.
inline double stretch_by_tension(double axial_ratio) {
  double stretch = 1;
  for (int step = 0; step < 8; ++step)
    stretch -= (stretch * stretch - 1 / stretch - 3 * axial_ratio) / (2 * stretch + 1 / (stretch * stretch));
  return stretch;
}

/// Length over width of it.
inline double aspect_by_tension(double axial_ratio) { return std::pow(stretch_by_tension(axial_ratio), 1.5); }

/// The inverse: the tension over Young's modulus.
inline double tension_by_aspect(double aspect) {
  const double stretch = std::pow(aspect, 2.0 / 3);
  return (stretch * stretch - 1 / stretch) / 3;
}

}  // namespace rheocyte
