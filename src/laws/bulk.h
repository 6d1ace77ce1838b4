// Elastic laws of the cell's bulk at a point (docs/theory.md, eq:bulk). Incompressible, mu = E/3.
#pragma once
#include "case/problem.h"
#include "laws/tensor.h"

namespace rheocyte {

/// mu in units of S, and the share a of the neo-Hookean member: 1 = neo-Hookean, 0 = Euler-Almansi ("linear").
struct Bulk {
  double shear_modulus = 1;
  double mooney_share = 1;
  double viscosity = 0;  ///< eta1 U / (R S); acts while the cell moves
  double reynolds = 0;   ///< of the cell's density, rho1 U^2 / S; likewise
};

/// Extra Kirchhoff stress J sigma = mu [a B + (1 - a)(I1 B - B^2)] - mu (2 - a) I, B = F F^T; the pressure comes on
/// top of it. For J = 1 this is mu [a (B - I) + (1 - a)(I - B^-1)] but for a multiple of I, because of Cayley and
/// Hamilton's I1 B - B^2 = I2 I - J^2 B^-1. Written so, it derives from polyconvex energies off J = 1 as well:
/// elements that meet J = 1 only on average would otherwise lose stability long before the material does.
template <class T>
Tensor<T> elastic_stress(const Bulk& bulk, const Tensor<T>& F) {
  const double a = bulk.mooney_share, mu = bulk.shear_modulus;
  const Tensor<T> B = F * F.transpose();
  Tensor<T> tau = B * T(mu * a);
  if (a != 1) tau += (B * B.trace() - B * B) * T(mu * (1 - a));
  for (int i = 0; i < 3; ++i) tau(i, i) -= T(mu * (2 - a));
  return tau;
}

/// Strain energy per volume whose derivative the stress is (for det F = 1): mu/2 [a (tr B - 3) + (1-a)(tr B^-1 - 3)].
template <class T>
T strain_energy(const Bulk& bulk, const Tensor<T>& F) {
  const double a = bulk.mooney_share, mu = bulk.shear_modulus;
  return (F.squaredNorm() - T(3)) * T(0.5 * mu * a) + (inverse(F).squaredNorm() - T(3)) * T(0.5 * mu * (1 - a));
}

}  // namespace rheocyte
