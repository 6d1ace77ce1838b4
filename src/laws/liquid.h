// Laws of the liquid at a point (docs/theory.md, eq:liquid). Dimensionless: stresses in S, velocities in U.
#pragma once
#include <cmath>

namespace rheocyte {

enum class LiquidLaw { newtonian, power_law };

struct Liquid {
  LiquidLaw law = LiquidLaw::newtonian;
  double exponent = 1;             ///< flow behaviour index n of the power law
  double shear_rate_floor = 1e-2;  ///< regularisation of the power law, in U/R: gdot -> sqrt(gdot^2 + floor^2)
  double reynolds = 0;             ///< rho U^2 / S; 0 = Stokes
};

/// Viscous part 2 eta D of the Cauchy stress for the velocity gradient (grad v)_ij = d v_i / d x_j, a full 3 x 3
/// tensor. Power law: eta = gdot^(n-1), gdot^2 = 2 D:D + floor^2.
template <class Tensor>
Tensor viscous_stress(const Liquid& liquid, const Tensor& grad_v) {
  using T = typename Tensor::Scalar;
  Tensor two_D = grad_v + grad_v.transpose();
  if (liquid.law == LiquidLaw::newtonian) return two_D;
  using std::pow;
  const T gdot_squared = two_D.squaredNorm() * T(0.5) + T(liquid.shear_rate_floor * liquid.shear_rate_floor);
  const T eta = pow(gdot_squared, 0.5 * (liquid.exponent - 1));
  return two_D * eta;
}

/// Convective inertia Re (grad v) v per volume of a steady flow.
template <class Vector, class Tensor>
Vector inertia(const Liquid& liquid, const Vector& v, const Tensor& grad_v) {
  return grad_v * v * typename Tensor::Scalar(liquid.reynolds);
}

/// Axial velocity of the undisturbed flow at distance r from the axis of a tube of radius 1 and mean speed 1.
inline double undisturbed_velocity(const Liquid& liquid, double r) {
  const double n = liquid.exponent;
  return (3 * n + 1) / (n + 1) * (1 - std::pow(r, (n + 1) / n));
}

/// Pressure gradient (positive number, in S/R) of a power-law liquid in a tube of radius 1 at mean speed 1: 8 for n
/// = 1.
inline double undisturbed_pressure_gradient(double exponent) {
  return 2 * std::pow((3 * exponent + 1) / exponent, exponent);
}

/// Pressure gradient (positive number) of the undisturbed flow.
inline double undisturbed_pressure_gradient(const Liquid& liquid) {
  return undisturbed_pressure_gradient(liquid.exponent);
}

}  // namespace rheocyte
