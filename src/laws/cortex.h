// Laws of the cell's surface at a point (docs/theory.md, eq:cortex): elastic shell, surface tension, bending.
//
// Each law is an energy; tensions (laws/surface_form.h) are its derivatives. Stretches: l1 = ds/ds0 along
// the meridian, l2 = r/r0' in the hoop direction. Moduli and tensions in units of S R, bending stiffness of S R^3.
#pragma once
#include "laws/choices.h"
#include "laws/constant.h"

namespace rheocyte {

struct Cortex {
  CortexLaw law = CortexLaw::none;
  double modulus = 0;        ///< E2D / (S R)
  double tension = 0;        ///< gamma / (S R)
  double bending = 0;        ///< stiffness c_b / (S R^3)
  double rest_stretch = 1;   ///< along x, of the sphere into the spheroid that the shell rests in (eq:rest-shape)
  double axial_tension = 0;  ///< of the surroundings of a pure shell, over S; that of a solid is in Bulk
  double area_constant = 1;  ///< Skalak's C: how much his shell resists a change of area
};

/// By which the pressure in a sphere at rest exceeds that around it (Laplace).
inline double rest_pressure(const Cortex& cortex, double radius) { return 2 * cortex.tension / radius; }

/// Poisson's ratio of the shell at small strains, where all its laws have the modulus E2D (docs/theory.md, eq:skalak).
inline double poisson_ratio(const Cortex& cortex) {
  return cortex.law == CortexLaw::skalak ? cortex.area_constant / (1 + cortex.area_constant) : 0.5;
}

/// Elastic energy of the shell per CURRENT area, zero at rest, of two invariants: the sum of the principal stretches
/// and their product, the stretch of the area. Poisson's ratio 1/2, K = 4/3 E2D, but for skalak: C / (1 + C). linear:
/// the energy whose tensions are eq. 19 of Mokbel et al. 2017 (there is one for this Poisson's ratio alone);
/// thin_shell, neo_hookean: their eqs. 8a and 8b; neo_hookean_reference, skalak (Skalak et al. 1973,
/// doi 10.1016/S0006-3495(73)85983-1): energies per reference area.
template <class T>
T shell_energy_of(const Cortex& cortex, const T& sum, const T& area) {
  const double E2D = cortex.modulus, K = 4.0 / 3 * E2D;
  const T e = sum - constant<T>(2);                     // e1 + e2
  const T squares = sum * sum - constant<T>(2) * area;  // l1^2 + l2^2
  const T incompressible = squares + constant<T>(1) / (area * area) - constant<T>(3);
  switch (cortex.law) {
    case CortexLaw::none: return constant<T>(0);
    case CortexLaw::linear: return constant<T>(K / 2) * (e - constant<T>(1) + constant<T>(1) / area);
    case CortexLaw::thin_shell: return constant<T>(K / 2) * (e * e - (area - sum + constant<T>(1)));
    case CortexLaw::neo_hookean: return constant<T>(E2D / 6) * incompressible;
    case CortexLaw::neo_hookean_reference: return constant<T>(E2D / 6) * incompressible / area;
    case CortexLaw::skalak: {
      const T I1 = squares - constant<T>(2), I2 = area * area - constant<T>(1);
      const double C = cortex.area_constant, G = E2D * (1 + C) / (2 * (1 + 2 * C));
      return constant<T>(G / 4) * (I1 * I1 + constant<T>(2) * (I1 - I2) + constant<T>(C) * I2 * I2) / area;
    }
  }
  return constant<T>(0);
}

/// The same of the principal stretches.
template <class T>
T shell_energy(const Cortex& cortex, const T& l1, const T& l2) {
  return shell_energy_of(cortex, T(l1 + l2), T(l1 * l2));
}

/// Bending energy per current area of the total curvature kappa (twice the mean curvature): c_b/8 kappa^2.
template <class T>
T bending_energy(const Cortex& cortex, const T& kappa) {
  return constant<T>(cortex.bending / 8) * kappa * kappa;
}

}  // namespace rheocyte
