#include "laws/bulk.h"

#include <gtest/gtest.h>

#include "derivative_error.h"
#include "random_states.h"

namespace rheocyte::bulk_test {
namespace {

using test::RandomStates;
using test::states;

// Some dozen operations on stresses of order ten.
constexpr double rounding = 1e-12;
constexpr double mu = 1.7;

constexpr Bulk fung(double stiffening) { return {.law = BulkLaw::fung, .shear_modulus = mu, .stiffening = stiffening}; }

// linear (Euler-Almansi), neo-Hookean, Mooney-Rivlin between them, and Fung's exponential of the neo-Hookean energy.
constexpr std::array laws = {Bulk{BulkLaw::linear, mu}, Bulk{BulkLaw::neo_hookean, mu},
                             Bulk{BulkLaw::mooney_rivlin, mu, 0.3}, fung(0.6), fung(1)};

const Tensor<double> I = Tensor<double>::Identity();

Tensor<double> deviator(const Tensor<double>& A) { return A - I * (A.trace() / 3); }

/// d/de of the function at e = 0.
template <class Function>
double slope(const Function& function) {
  return function(Dual<double, 1>(0, 0)).slope(0);
}

/// F + e A F: the deformation gradient after a further small deformation A.
Tensor<Dual<double, 1>> moved(const Tensor<double>& F, const Tensor<double>& A, const Dual<double, 1>& e) {
  const Tensor<double> AF = A * F;
  Tensor<Dual<double, 1>> result;
  for (int i = 0; i < 9; ++i) result(i) = F(i) + e * AF(i);
  return result;
}

TEST(Bulk, TheStressHasTheDerivativeOfCentralDifferences) {
  // Dual numbers are exact for every law.
  RandomStates random;
  for (const Bulk& bulk : laws) {
    const auto law = test::entrywise([&](const auto& F) { return elastic_stress(bulk, F); });
    for (int i = 0; i < states; ++i) {
      EXPECT_LT(test::derivative_error<9>(law, random.deformation_gradient().entries), test::derivative_tolerance);
    }
  }
}

TEST(Bulk, TheSpheroidThatItRestsInHasNoStress) {
  // And from there the stress is that of the same deformation of a sphere.
  RandomStates random;
  constexpr double a = 1.3;
  const Tensor<double> to_rest = test::diagonal(a, 1 / std::sqrt(a), 1 / std::sqrt(a));
  for (const Bulk& bulk : laws) {
    Bulk elongated = bulk;
    elongated.rest_stretch = a;
    EXPECT_LT(elastic_stress(elongated, to_rest).norm(), rounding);
    for (int i = 0; i < states; ++i) {
      const Tensor<double> F = random.deformation_gradient();
      EXPECT_LT((elastic_stress(elongated, Tensor<double>(F * to_rest)) - elastic_stress(bulk, F)).norm(), 1e-11);
    }
    const auto law = test::entrywise([&](const auto& F) { return loaded_stress(elongated, F); });
    EXPECT_LT(test::derivative_error<9>(law, random.deformation_gradient().entries), test::derivative_tolerance);
  }
}

TEST(Bulk, TheStressIsObjectiveAndTheMaterialIsotropic) {
  // A rotation after the deformation turns the stress with it: tau(Q F) = Q tau(F) Q^T; one before changes nothing.
  RandomStates random;
  for (const Bulk& bulk : laws) {
    for (int i = 0; i < states; ++i) {
      const Tensor<double> F = random.deformation_gradient(), Q = random.rotation();
      const Tensor<double> tau = elastic_stress(bulk, F);
      EXPECT_LT((elastic_stress(bulk, Tensor<double>(Q * F)) - Q * tau * Q.transpose()).norm(), rounding);
      EXPECT_LT((elastic_stress(bulk, Tensor<double>(F * Q)) - tau).norm(), rounding);
    }
  }
}

TEST(Bulk, TheUndeformedMaterialIsFreeOfStress) {
  // tau(I) = 0 and tau(Q) = 0.
  RandomStates random;
  for (const Bulk& bulk : laws) {
    EXPECT_LT(elastic_stress(bulk, I).norm(), rounding);
    EXPECT_LT(elastic_stress(bulk, random.rotation()).norm(), rounding);
  }
}

TEST(Bulk, TheStressOfAnIsochoricDeformationIsThatOfMooneyAndRivlin) {
  // At det F = 1 the stress is mu [a (B - I) + (1 - a)(I - B^-1)] but for a multiple of I.
  RandomStates random;
  for (const Bulk& bulk : laws) {
    if (bulk.law == BulkLaw::fung) continue;
    const double a = neo_hookean_fraction(bulk);
    for (int i = 0; i < states; ++i) {
      const Tensor<double> F = random.isochoric(), B = F * F.transpose();
      const Tensor<double> sigma = mu * (a * (B - I) + (1 - a) * (I - inverse(B)));
      EXPECT_LT(deviator(elastic_stress(bulk, F) - sigma).norm(), rounding);
    }
  }
}

/// mu/(2 b) (exp(b (I1 - 3)) - 1).
template <class T>
T fung_energy(const Bulk& bulk, const T& I1) {
  const double b = bulk.stiffening;
  using std::exp;
  return (exp((I1 - T(3)) * T(b)) - T(1)) * T(mu / (2 * b));
}

/// Strain energy per volume of isochoric deformations: mu/2 [a (tr B - 3) + (1-a)(tr B^-1 - 3)], or that of Fung.
template <class T>
T strain_energy(const Bulk& bulk, const Tensor<T>& F) {
  if (bulk.law == BulkLaw::fung) return fung_energy(bulk, F.squaredNorm());
  const double a = neo_hookean_fraction(bulk);
  return (F.squaredNorm() - T(3)) * T(0.5 * mu * a) + (inverse(F).squaredNorm() - T(3)) * T(0.5 * mu * (1 - a));
}

TEST(Bulk, TheStressOfAnIsochoricDeformationIsTheDerivativeOfTheStrainEnergy) {
  // dW = tau : A for F -> (I + e A) F with tr A = 0, det F = 1.
  RandomStates random;
  for (const Bulk& bulk : laws) {
    for (int i = 0; i < states; ++i) {
      const Tensor<double> F = random.isochoric(), A = random.trace_free(1);
      const double dW = slope([&](const auto& e) { return strain_energy(bulk, moved(F, A, e)); });
      EXPECT_NEAR(dW, dot(elastic_stress(bulk, F), A), rounding);
    }
  }
}

/// mu/2 [a I1 + (1 - a) I2] - mu (2 - a) ln J, I2 = (I1^2 - B : B) / 2: the polyconvex energy off J = 1. That of Fung
/// is an increasing convex function of I1, less mu ln J.
template <class T>
T polyconvex_energy(const Bulk& bulk, const Tensor<T>& F) {
  const double a = neo_hookean_fraction(bulk);
  const Tensor<T> B = F * F.transpose();
  const T I1 = B.trace(), I2 = (I1 * I1 - B.squaredNorm()) * T(0.5);
  using std::log;
  if (bulk.law == BulkLaw::fung) return fung_energy(bulk, I1) - log(determinant(F)) * T(mu);
  return (I1 * T(a) + I2 * T(1 - a)) * T(0.5 * mu) - log(determinant(F)) * T(mu * (2 - a));
}

TEST(Bulk, TheStressDerivesFromAPolyconvexEnergyOffUnitVolumeToo) {
  // dW = tau : A for every F and every A, if W = mu/2 [a I1 + (1 - a) I2] - mu (2 - a) ln J.
  RandomStates random;
  for (const Bulk& bulk : laws) {
    for (int i = 0; i < states; ++i) {
      const Tensor<double> F = random.deformation_gradient(), A = random.tensor(1);
      const double dW = slope([&](const auto& e) { return polyconvex_energy(bulk, moved(F, A, e)); });
      EXPECT_NEAR(dW, dot(elastic_stress(bulk, F), A), 10 * rounding);
    }
  }
}

TEST(Bulk, TheStrainEnergyIsPositiveAndZeroWithoutDeformation) {
  // W(I) = 0 and W(F) > 0 for isochoric deformations.
  RandomStates random;
  for (const Bulk& bulk : laws) {
    EXPECT_NEAR(strain_energy(bulk, I), 0, rounding);
    for (int i = 0; i < states; ++i) EXPECT_GT(strain_energy(bulk, random.isochoric()), 0);
  }
}

TEST(Bulk, AllLawsAgreeForSmallStrains) {
  // tau = 2 mu eps + O(eps^2), eps = (H + H^T)/2 with tr H = 0: the derivative at F = I is exact.
  RandomStates random;
  for (const Bulk& bulk : laws) {
    for (int i = 0; i < states; ++i) {
      const Tensor<double> H = random.trace_free(1);
      const Tensor<double> two_eps = H + H.transpose();
      const auto tau = elastic_stress(bulk, moved(I, H, Dual<double, 1>(0, 0)));
      for (int k = 0; k < 9; ++k) EXPECT_NEAR(tau(k).slope(0), mu * two_eps(k), rounding);
    }
  }
}

TEST(Bulk, UniaxialTensionHasTheTextbookStress) {
  // sigma_x - sigma_r = mu [a (l^2 - 1/l) + (1 - a)(l - 1/l^2)] at stretch l, traction-free sides; slope E = 3 mu. With
  // Fung's law mu exp(b (l^2 + 2/l - 3)) (l^2 - 1/l).
  for (const Bulk& bulk : laws) {
    const double a = neo_hookean_fraction(bulk);
    for (const double l : {0.5, 0.9, 1.1, 2.0}) {
      const Tensor<double> F = test::diagonal(l, 1 / std::sqrt(l), 1 / std::sqrt(l));
      const Tensor<double> tau = elastic_stress(bulk, F);
      const double factor = bulk.law == BulkLaw::fung ? std::exp(bulk.stiffening * (l * l + 2 / l - 3)) : 1;
      const double expected = mu * factor * (a * (l * l - 1 / l) + (1 - a) * (l - 1 / (l * l)));
      EXPECT_NEAR(tau(0, 0) - tau(1, 1), expected, rounding * std::max(1.0, std::abs(expected)));
      EXPECT_NEAR(tau(1, 1), tau(2, 2), rounding);
    }
  }
}

TEST(Fung, AStretchOfAThirdHasTheStressOfAHandCalculation) {
  // b = 1, l = 1.3: (1.69 - 0.769231) exp(0.228462) = 1.15710, known to its digits; neo-Hookean 0.92077.
  const Tensor<double> F = test::diagonal(1.3, 1 / std::sqrt(1.3), 1 / std::sqrt(1.3));
  const Tensor<double> tau = elastic_stress(fung(1), F), neo_hookean = elastic_stress(fung(0), F);
  EXPECT_NEAR((tau(0, 0) - tau(1, 1)) / mu, 1.15710, 5e-6);
  EXPECT_NEAR((neo_hookean(0, 0) - neo_hookean(1, 1)) / mu, 0.92077, 5e-6);
}

TEST(Fung, WithoutStiffeningItIsNeoHookean) {
  // And tends to it: the stresses differ by mu b (I1 - 3) B, with I1 - 3 and B of order one.
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const Tensor<double> F = random.deformation_gradient();
    const Tensor<double> neo_hookean = elastic_stress(Bulk{BulkLaw::neo_hookean, mu}, F);
    EXPECT_LT((elastic_stress(fung(0), F) - neo_hookean).norm(), rounding);
    const double small = 1e-6;
    EXPECT_LT((elastic_stress(fung(small), F) - neo_hookean).norm(), small * 20 * mu);
  }
}

constexpr Bulk maxwell{.shear_modulus = 0, .viscosity = 0.4, .branch_modulus = mu};

TEST(MaxwellBranch, ASuddenStrainFindsASpring) {
  // In a step from rest that is far shorter than the relaxation time: mu (B - I), within the fraction of the step.
  RandomStates random;
  constexpr double rate = 1e9;
  for (int i = 0; i < states; ++i) {
    const Tensor<double> F = random.deformation_gradient(), history = -rate * I;  // G = I before
    const Tensor<double> spring = mu * (F * F.transpose() - I);
    EXPECT_LT((branch_stress(maxwell, F, rate, history) - spring).norm(), 1e-7 * (1 + spring.norm()));
  }
}

TEST(MaxwellBranch, ASustainedStrainLeavesNoStress) {
  // At rest G is C^-1.
  RandomStates random;
  for (int i = 0; i < states; ++i) {
    const Tensor<double> F = random.deformation_gradient();
    EXPECT_LT(branch_stress(maxwell, F, 0, Tensor<double>::Zero()).norm(), rounding);
  }
}

TEST(MaxwellBranch, SlowShearFindsAViscosity) {
  // A steady velocity gradient L for long: 2 eta D within the square of the Weissenberg number, 1e-4.
  RandomStates random;
  constexpr double size = 1e-4, step = 0.05;
  const Tensor<double> L = random.trace_free(size * mu / maxwell.viscosity), D = (L + L.transpose()) / 2;
  Tensor<double> F = I, G = I, stress;
  for (int k = 0; k < 400; ++k) {
    F = inverse(I - L * step) * F;
    const Tensor<double> history = -G / step, C = F.transpose() * F;
    stress = branch_stress(maxwell, F, 1 / step, history);
    G = branch_metric(maxwell, inverse(C), 1 / step, history);
    EXPECT_LT((stress - mu * (F * G * F.transpose() - I)).norm(), rounding);
  }
  EXPECT_LT((stress - 2 * maxwell.viscosity * D).norm(), 10 * size * maxwell.viscosity * D.norm());
}

}  // namespace
}  // namespace rheocyte::bulk_test
