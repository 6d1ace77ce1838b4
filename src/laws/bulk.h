// Elastic laws of the cell's bulk at a point (docs/theory.md, eq:bulk, eq:rest-shape). Incompressible, mu = E/3.
#pragma once
#include <cmath>

#include "laws/choices.h"

namespace rheocyte {

struct Bulk {
  BulkLaw law = BulkLaw::neo_hookean;
  double shear_modulus = 10;  ///< mu / S = E / (3 S)
  double c1_fraction = 0.5;   ///< of the neo-Hookean member in the Mooney-Rivlin law
  double viscosity = 0;       ///< eta1 U / (R S); acts only while the cell moves
  double branch_modulus = 0;  ///< over S, of a spring in series with the viscosity; 0: none, it acts beside the solid
  double reynolds = 0;        ///< of the cell's density, rho1 U^2 / S; as above
  double rest_stretch = 1;    ///< along x, of the sphere into the spheroid without stress (eq:rest-shape)
  double axial_tension = 0;   ///< of the surroundings along x, over S (eq:axial-tension)
  double stiffening = 1;      ///< b of Fung's law; 0: neo-Hookean
};

/// Fraction a of the neo-Hookean member in the law: 1 = neo-Hookean, 0 = Euler-Almansi. Fung's law is neo-Hookean at
/// small strains.
constexpr double neo_hookean_fraction(const Bulk& bulk) {
  switch (bulk.law) {
    case BulkLaw::linear: return 0;
    case BulkLaw::mooney_rivlin: return bulk.c1_fraction;
    case BulkLaw::neo_hookean:
    case BulkLaw::fung:
    case BulkLaw::none: return 1;
  }
  return 1;
}

/// The deformation gradient from the spheroid diag(a, a^(-1/2), a^(-1/2)) X to the place of X, with F that from X.
template <class Tensor>
Tensor from_rest_shape(Tensor F, double rest_stretch) {
  using T = typename Tensor::Scalar;
  const T along(1 / rest_stretch), across(std::sqrt(rest_stretch));
  for (int i = 0; i < 3; ++i) {
    F(i, 0) = F(i, 0) * along;
    F(i, 1) = F(i, 1) * across;
    F(i, 2) = F(i, 2) * across;
  }
  return F;
}

/// By which Fung's law is stiffer than the neo-Hookean one: exp(b (I1 - 3)), from the energy
/// mu / (2 b) (exp(b (I1 - 3)) - 1); 1 for the other laws (docs/theory.md, eq:fung).
template <class Tensor>
typename Tensor::Scalar stiffening_factor(const Bulk& bulk, const Tensor& B) {
  using T = typename Tensor::Scalar;
  using std::exp;
  return bulk.law == BulkLaw::fung ? exp((B.trace() - T(3)) * T(bulk.stiffening)) : T(1);
}

/// Extra Kirchhoff stress J sigma = mu [a B + (1 - a)(I1 B - B^2)] - mu (2 - a) I, B = F F^T; the pressure comes on
/// top of it. For J = 1 this is mu [a (B - I) + (1 - a)(I - B^-1)] but for a multiple of I, because of Cayley and
/// Hamilton's I1 B - B^2 = I2 I - J^2 B^-1. Written so, it derives from polyconvex energies off J = 1 as well:
/// elements that meet J = 1 only on average would otherwise lose stability long before the material does.
/// Fung's law is that of a = 1 with mu exp(b (I1 - 3)) B in place of mu B, polyconvex too. Where the cell is free of
/// stress as a spheroid, F is that from the spheroid.
template <class Tensor>
Tensor elastic_stress(const Bulk& bulk, const Tensor& F) {
  using T = typename Tensor::Scalar;
  const double a = neo_hookean_fraction(bulk), mu = bulk.shear_modulus;
  const Tensor from_rest = bulk.rest_stretch == 1 ? F : from_rest_shape(F, bulk.rest_stretch);
  const Tensor B = from_rest * from_rest.transpose();
  Tensor tau = B * T(mu * a);
  if (bulk.law == BulkLaw::fung) tau = tau * stiffening_factor(bulk, B);
  if (a != 1) tau += (B * B.trace() - B * B) * T(mu * (1 - a));
  for (int i = 0; i < 3; ++i) tau(i, i) -= T(mu * (2 - a));
  return tau;
}

/// The same less the axial tension of the surroundings: a traction T n_x e_x on the surface does the work of an even
/// stress T e_x e_x in the cell, by the divergence theorem (eq:axial-tension).
template <class Tensor>
Tensor loaded_stress(const Bulk& bulk, const Tensor& F) {
  Tensor tau = elastic_stress(bulk, F);
  tau(0, 0) -= typename Tensor::Scalar(bulk.axial_tension);
  return tau;
}

/// A Maxwell branch at a material point. Its natural metric G, the inverse of C in its unstressed state, follows
/// dG/dt = (C^-1 - G) / tau with tau = viscosity / branch_modulus; within a step dG/dt = rate G + history
/// (docs/theory-time.md, eq:branch).
template <class Tensor, class History>
Tensor branch_metric(const Bulk& bulk, const Tensor& inverse_C, double rate, const History& history) {
  using T = typename Tensor::Scalar;
  const double relaxation = bulk.branch_modulus / bulk.viscosity;
  return (inverse_C * T(relaxation) - history.template cast<T>()) * T(1 / (rate + relaxation));
}

/// Its extra Kirchhoff stress mu1 (F G F^T - I) with the G at the end of the step: the upper-convected Maxwell law.
template <class Tensor, class History>
Tensor branch_stress(const Bulk& bulk, const Tensor& F, double rate, const History& history) {
  using T = typename Tensor::Scalar;
  const double relaxation = bulk.branch_modulus / bulk.viscosity, scale = bulk.branch_modulus / (rate + relaxation);
  const Tensor carried = F * history.template cast<T>() * F.transpose();
  Tensor tau = carried * T(-scale);
  for (int i = 0; i < 3; ++i) tau(i, i) += T(scale * relaxation - bulk.branch_modulus);
  return tau;
}

}  // namespace rheocyte
