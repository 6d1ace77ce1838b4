// Small displacements of an elastic sphere and of an elastic shell under a traction (docs/theory-analytic.md, sec.
// "response").
#pragma once
#include "analytic/surface_modes.h"

namespace rheocyte {

/// Displacement of the surface of an incompressible elastic sphere, in r0 per (traction / shear modulus)
/// (eq:solid-response). The traction must be free of a resultant force, N_1 = -2 T_1; the barycentre stays.
SurfaceModes solid_response(const SurfaceModes& traction);

/// Displacement of an elastic membrane around an incompressible liquid, in r0 per (r0 traction / E2D), Poisson's ratio
/// 1/2 (eq:shell-response). `tension_ratio` = gamma / E2D >= 0 is the tension of the undeformed sphere. The same demand
/// on the traction; the barycentre of the enclosed liquid stays.
SurfaceModes shell_response(const SurfaceModes& traction, double tension_ratio);

}  // namespace rheocyte
