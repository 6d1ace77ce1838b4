// A rigid sphere that floats on the axis of a tube in Poiseuille flow, without inertia (docs/theory-analytic.md, sec.
// "flow").
#pragma once
#include "analytic/surface_modes.h"

namespace rheocyte {

/// Radii of the sphere, in tube radii, for which the series below are good to 1e-10.
inline constexpr double max_sphere_in_tube = 0.965;

/// Lengths in R, velocities in u_max, the velocity of the undisturbed flow on the axis, stresses in eta u_max / R.
struct SphereInTube {
  double lambda = 0;         ///< radius of the sphere
  double velocity = 0;       ///< of the sphere that no force acts on (eq:force-free)
  double drag_towed = 0;     ///< K1: drag of the sphere towed through liquid at rest, in 6 pi eta r0 U
  double drag_held = 0;      ///< K2: drag of the sphere held in the flow, in 6 pi eta r0 u_max; velocity = K2 / K1
  double pressure_drop = 0;  ///< in addition to that of the undisturbed flow, at equal flow rate (eq:pressure-drop)
  SurfaceModes traction;     ///< N_l, T_l of the force per area of the liquid on the sphere (eq:traction)
  /// Stream function round the sphere, in its frame (eq:stream-function), scaled to the sphere's radius: values of the
  /// radial functions at r = lambda. Entry j belongs to n = 2 (j + 1).
  Eigen::ArrayXd A, B, C, D;
};

/// The number of even functions n = 2, 4, ... that makes the traction good to 1e-10 for a sphere of this radius.
int functions_for(double lambda);

/// Solves eq:reflection with no slip on the sphere; 0 < lambda <= max_sphere_in_tube.
SphereInTube sphere_in_tube(double lambda);

/// The same with a chosen number of functions, 2 .. functions_for(max_sphere_in_tube).
SphereInTube sphere_in_tube(double lambda, int functions);

}  // namespace rheocyte
