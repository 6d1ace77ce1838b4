// Signs by which a wrinkled surface is distinguished from a smooth one (docs/theory.md, sec. "surface instability").
#pragma once
#include "shape/contour.h"

namespace rheocyte {

/// A convex cell has zero of each; a plain rear dent has one change of sign and nothing else.
struct SurfaceSmoothness {
  int curvature_sign_changes = 0;  ///< of the meridional curvature from front to rear pole, weak wiggles left out
  int flank_bridges = 0;           ///< separate chords of the convex hull that do not close a dent at a pole
  double hidden_deformation = 0;   ///< deformation that the hull hides away from the dents at the poles; NaN if invalid
};

/// Curvatures below 0.02 / (radius of the circle of equal area) count as zero: nearly straight flanks are not wrinkles.
SurfaceSmoothness surface_smoothness(const Contour& contour);

}  // namespace rheocyte
