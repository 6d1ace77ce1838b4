// The effective Young's modulus of a cell: that of the homogeneous incompressible solid which a small axial tension of
// the surroundings elongates as much (docs/theory-analytic.md, sec. "effective").
#pragma once
#include "laws/media.h"

namespace rheocyte {

/// An incompressible sphere that is at rest without a load, in any consistent units (SI: Pa, N/m, J, m). T is double,
/// or a dual number for derivatives (laws/derivative.h).
template <class T>
struct ElasticSphere {
  T young_modulus;      ///< E of the solid that fills it; 0: a liquid
  T surface_modulus;    ///< E2D of the elastic surface, Young's modulus x thickness; 0: none
  T poisson_ratio;      ///< of the surface, below 1: laws/cortex.h
  T tension;            ///< gamma, even over the surface at rest and independent of its strain
  T bending_stiffness;  ///< c_b, of the energy c_b/8 kappa^2
  T radius;             ///< r0
};

/// eq:effective-modulus, in the unit of E. The sphere must hold shear: E or E2D is positive.
template <class T>
T effective_modulus(const ElasticSphere<T>& sphere) {
  const T E = sphere.young_modulus, nu = sphere.poisson_ratio, r0 = sphere.radius;
  const T surface = sphere.surface_modulus / (r0 * (1.0 - nu));
  const T of_shape = 4.0 * sphere.tension / r0 + 6.0 * sphere.bending_stiffness / (r0 * r0 * r0);
  // eq:axial-stiffness.
  const T normal = 13.0 / 6 * E + 2.0 * surface + of_shape;
  const T tangential = 10.0 * E + 6.0 * (5.0 + nu) / (1.0 + nu) * surface;
  const T coupling = 3.0 * E + 6.0 * surface;
  return (normal * tangential - coupling * coupling) / (2.0 / 3 * tangential + 2.0 * coupling);
}

/// eq:drop-modulus: of a drop, a liquid whose surface is not elastic either. It cannot hold what pulls along its
/// surface; the tension's part along the normal elongates it.
template <class T>
T effective_modulus_of_drop(const T& tension, const T& bending_stiffness, const T& radius) {
  return 6.0 * tension / radius + 9.0 * bending_stiffness / (radius * radius * radius);
}

/// Of a cell with the radius r0 = radius_ratio R, in S. At small strains all laws of the bulk are one. A viscosity, and
/// a spring in series with one, hold nothing for long. Not a number for a cell whose shape at rest is no sphere.
double effective_modulus(const Media&, double radius_ratio);

}  // namespace rheocyte
