// Laws of the cell's surface at a point (docs/theory.md, eq:cortex): elastic shell, surface tension, bending.
//
// Each law is an energy; tensions, and with them the virtual work, are its derivatives. Stretches: l1 = ds/ds0 along
// the meridian, l2 = r/r0' in the hoop direction. Moduli and tensions in units of S R, bending stiffness of S R^3.
#pragma once
#include <array>
#include <cmath>

#include "case/problem.h"
#include "laws/derivative.h"

namespace rheocyte {

/// Parameters of the surface, see case/problem.h for their meaning.
struct Cortex {
  CortexLaw law = CortexLaw::none;
  double modulus = 0;
  double tension = 0;
  double bending = 0;
};

/// Elastic energy of the shell per CURRENT area, zero at rest. Poisson's ratio 1/2, K = 4/3 E2D.
/// linear: the energy whose tensions are eq. 19 of Mokbel et al. 2017 (there is one for this Poisson's ratio alone);
/// thin_shell, neo_hookean: their eqs. 8a and 8b; neo_hookean_reference: the membrane law, energy per reference area.
template <class T>
T shell_energy(const Cortex& cortex, const T& l1, const T& l2) {
  const double E2D = cortex.modulus, K = 4.0 / 3 * E2D;
  const T e1 = l1 - constant<T>(1), e2 = l2 - constant<T>(1), area = l1 * l2;
  switch (cortex.law) {
    case CortexLaw::none: return constant<T>(0);
    case CortexLaw::linear: return constant<T>(K / 2) * (e1 + e2 - constant<T>(1) + constant<T>(1) / area);
    case CortexLaw::thin_shell: return constant<T>(K / 2) * (e1 * e1 + e2 * e2 + e1 * e2);
    case CortexLaw::neo_hookean:
      return constant<T>(E2D / 6) * (l1 * l1 + l2 * l2 + constant<T>(1) / (area * area) - constant<T>(3));
    case CortexLaw::neo_hookean_reference:
      return constant<T>(E2D / 6) * (l1 * l1 + l2 * l2 + constant<T>(1) / (area * area) - constant<T>(3)) / area;
  }
  return constant<T>(0);
}

/// Principal Cauchy tensions T_i = f + l_i df/dl_i of the energy f per current area, surface tension included.
template <class T>
std::array<T, 2> principal_tensions(const Cortex& cortex, const T& l1, const T& l2) {
  const auto energy = [&](const auto& l) { return shell_energy(cortex, l[0], l[1]); };
  const auto [f, slope] = value_and_slopes<2, T>(energy, {l1, l2});
  return {f + l1 * slope[0] + constant<T>(cortex.tension), f + l2 * slope[1] + constant<T>(cortex.tension)};
}

/// Bending energy per current area of the total curvature kappa (twice the mean curvature): c_b/8 kappa^2.
template <class T>
T bending_energy(const Cortex& cortex, const T& kappa) {
  return constant<T>(cortex.bending / 8) * kappa * kappa;
}

}  // namespace rheocyte
