// Shape measures of a cell's contour as RT-DC programs define them (docs/theory.md, sec. "shape").
#pragma once
#include "shape/contour.h"
#include "shape/radius_modes.h"

namespace rheocyte {

/// Lengths in the unit of the contour. "Convex" is the closed contour's convex hull: the camera cannot see a dent.
struct ShapeMeasures {
  double area = 0, perimeter = 0, deformation = 0;              ///< of the convexified contour
  double area_raw = 0, perimeter_raw = 0, deformation_raw = 0;  ///< of the contour itself
  double volume = 0;                                            ///< of the body of revolution of the contour itself
  double barycentre = 0;                                        ///< of that body, axial coordinate
  double moment_ratio = 1;   ///< Lambda1 / Lambda2 of the convexified contour, < 1: elongated along the flow
  double inertia_ratio = 1;  ///< sqrt(Lambda2 / Lambda1)
  double moment_ratio_raw = 1;
  RadiusModes modes{}, modes_raw{};  ///< of the radius about each one's centroid
};

/// Integrates the polynomial pieces themselves, not a polygon (error of quadrature near rounding for smooth curves).
ShapeMeasures measure(const Contour&);

}  // namespace rheocyte
