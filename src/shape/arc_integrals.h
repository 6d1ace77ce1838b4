// Integrals over the plane figure and the body that a chain of arcs encloses with its mirror image at the axis.
#pragma once
#include "shape/convex_hull.h"

namespace rheocyte {

/// Mirrored figure (both halves) and body of revolution; x is counted from the origin that `integrate` was given.
struct ArcIntegrals {
  double area = 0, perimeter = 0;
  double area_x = 0;                ///< int x dA
  double area_xx = 0, area_yy = 0;  ///< int x^2 dA, int y^2 dA
  double volume = 0, volume_x = 0;  ///< int dV, int x dV

  double deformation() const;                        ///< 1 - 2 sqrt(pi A) / P
  double lateral_moment() const { return area_yy; }  ///< Lambda1; the figure is symmetric, so y0 = 0
  double axial_moment() const { return area_xx - area_x * area_x / area; }  ///< Lambda2
};

/// Gauss quadrature of the contour integrals: exact for area, moments and volume, the perimeter to rounding for smooth
/// arcs. `origin` should lie near the middle, so that the moments do not cancel.
ArcIntegrals integrate(const ArcChain& arcs, double origin);

}  // namespace rheocyte
