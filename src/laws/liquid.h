// Laws of the liquid at a point (docs/theory.md, eq:liquid): the viscosity as a function of the shear rate. All that
// follows from it, like the undisturbed flow in the tube (laws/developed_flow.h), asks this function.
//
// Numbers are in any consistent units. Solvers take U/R as the unit of rates and S = eta(U/R) U/R as that of stresses.
#pragma once
#include <cmath>

#include "laws/choices.h"

namespace rheocyte {

struct Liquid {
  LiquidLaw law = LiquidLaw::newtonian;
  double exponent = 1;             ///< flow behaviour index n; 1: Newtonian
  double shear_rate_floor = 1e-2;  ///< regularisation of the power law: gdot -> sqrt(gdot^2 + floor^2)
  double reynolds = 0;             ///< rho U^2 / S; 0 = Stokes
  double viscosity = 1;            ///< of the power law: at the shear rate 1; of carreau: at rest
  double infinite_viscosity = 0;   ///< of carreau: at infinite shear rate
  double relaxation_time = 0;      ///< of carreau: thinning begins at its inverse
  double yasuda_exponent = 2;      ///< of carreau: how sharply it begins

  bool operator==(const Liquid&) const = default;
};

/// eta as a function of gdot^2.
template <class T>
T viscosity(const Liquid& liquid, const T& gdot_squared) {
  using std::pow;
  switch (liquid.law) {
    case LiquidLaw::newtonian: return T(liquid.viscosity);
    case LiquidLaw::power_law:
      return pow(gdot_squared + liquid.shear_rate_floor * liquid.shear_rate_floor, 0.5 * (liquid.exponent - 1)) *
             liquid.viscosity;
    case LiquidLaw::carreau: {
      constexpr double rest = 1e-12;  // keeps derivatives finite at rest, where (lambda gdot)^a has a cusp for a < 2
      const double a = liquid.yasuda_exponent, zero = liquid.viscosity, infinite = liquid.infinite_viscosity;
      const T x = pow(gdot_squared * (liquid.relaxation_time * liquid.relaxation_time) + rest, a / 2);
      return pow(x + 1.0, (liquid.exponent - 1) / a) * (zero - infinite) + infinite;
    }
  }
  return T(liquid.viscosity);
}

/// The same liquid in units of a rate and of its own stress at that rate, where the viscosity is 1 at the rate 1 but
/// for the floor, which always is in units of the rate.
inline Liquid in_units_of_rate(Liquid liquid, double rate) {
  const double unit = liquid.law == LiquidLaw::carreau ? viscosity(liquid, rate * rate) : liquid.viscosity;
  liquid.viscosity /= unit;
  liquid.infinite_viscosity /= unit;
  liquid.relaxation_time *= rate;
  return liquid;
}

/// How far the liquid is from a Newtonian one, and the liquid at a fraction of that way, in the same units.
inline double thinning(const Liquid& liquid) { return std::abs(1 - liquid.exponent); }
inline Liquid at_thinning(Liquid liquid, double fraction) {
  liquid.exponent = std::lerp(1.0, liquid.exponent, fraction);
  if (fraction == 0) liquid.law = LiquidLaw::newtonian;
  return in_units_of_rate(liquid, 1);
}

/// Viscous part 2 eta D of the Cauchy stress for the velocity gradient (grad v)_ij = d v_i / d x_j, a full 3 x 3
/// tensor; gdot^2 = 2 D:D.
template <class Tensor>
Tensor viscous_stress(const Liquid& liquid, const Tensor& grad_v) {
  using T = typename Tensor::Scalar;
  const Tensor two_D = grad_v + grad_v.transpose();
  if (liquid.law == LiquidLaw::newtonian) return two_D * liquid.viscosity;
  return two_D * viscosity(liquid, T(two_D.squaredNorm() * T(0.5)));
}

/// Convective inertia Re (grad v) v per volume of a steady flow.
template <class Vector, class Tensor>
Vector inertia(const Liquid& liquid, const Vector& v, const Tensor& grad_v) {
  return grad_v * v * typename Tensor::Scalar(liquid.reynolds);
}

}  // namespace rheocyte
