// Laws of the liquid at a point (docs/theory.md, eq:liquid). Dimensionless: stresses in S, velocities in U.
#pragma once
#include <cmath>

#include "case/problem.h"
#include "laws/tensor.h"

namespace rheocyte {

/// Parameters of the liquid, see case/problem.h for their meaning.
struct Liquid {
  LiquidLaw law = LiquidLaw::newtonian;
  double exponent = 1;
  double shear_rate_floor = 0;
  double reynolds = 0;
};

/// Viscous part 2 eta D of the Cauchy stress for the velocity gradient (grad v)_ij = d v_i / d x_j.
/// Power law: eta = gdot^(n-1), gdot^2 = 2 D:D + floor^2.
template <class T>
Tensor<T> viscous_stress(const Liquid& liquid, const Tensor<T>& grad_v) {
  Tensor<T> two_D = grad_v + grad_v.transpose();
  if (liquid.law == LiquidLaw::newtonian) return two_D;
  using std::pow;
  const T gdot_squared = two_D.squaredNorm() * T(0.5) + T(liquid.shear_rate_floor * liquid.shear_rate_floor);
  const T eta = pow(gdot_squared, 0.5 * (liquid.exponent - 1));
  return two_D * eta;
}

/// Convective inertia Re (grad v) v per volume of a steady flow.
template <class T>
Vector<T> inertia(const Liquid& liquid, const Vector<T>& v, const Tensor<T>& grad_v) {
  return grad_v * v * T(liquid.reynolds);
}

/// Axial velocity of the undisturbed flow at distance r from the axis of a tube of radius 1 and mean speed 1.
inline double undisturbed_velocity(const Liquid& liquid, double r) {
  const double n = liquid.exponent;
  return (3 * n + 1) / (n + 1) * (1 - std::pow(r, (n + 1) / n));
}

/// Pressure gradient (positive number) of that flow.
inline double undisturbed_pressure_gradient(const Liquid& liquid) {
  return undisturbed_pressure_gradient(liquid.exponent);
}

}  // namespace rheocyte
