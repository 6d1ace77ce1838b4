#include "laws/weak_form.h"

#include <gtest/gtest.h>

#include "derivative_error.h"
#include "random_states.h"

namespace rheocyte {
namespace {

using test::RandomStates;
using test::states;

// Some dozen operations on stresses of order ten.
constexpr double rounding = 1e-12;

const std::array liquids = {Liquid{}, Liquid{LiquidLaw::newtonian, 1, 0, 0.8},
                            Liquid{LiquidLaw::power_law, 0.6, 0.1, 0}, Liquid{LiquidLaw::power_law, 0.6, 0.1, 0.8}};
constexpr std::array bulks = {Bulk{BulkLaw::linear, 12}, Bulk{BulkLaw::neo_hookean, 12},
                              Bulk{BulkLaw::mooney_rivlin, 12, 0.4}};

std::array<double, LiquidPoint::inputs> liquid_state(RandomStates& random) {
  const Place<double> place = random.place();
  std::array<double, LiquidPoint::inputs> f;
  for (double& value : f) value = random.number(-1, 1);
  for (int k = 0; k < 4; ++k) f[k] = place.G(k / 2, k % 2);
  f[4] = place.r;
  f[8] += 2;  // never near zero shear rate, where differences of the power law fail
  return f;
}

std::array<double, CellPoint::inputs> cell_state(RandomStates& random, const Place<double>& reference) {
  const Plane<double> G = reference.G + 0.3 * random.element_map() - 0.3 * Plane<double>::Identity();
  return {G(0, 0), G(0, 1), G(1, 0), G(1, 1), reference.r * random.number(0.8, 1.2), random.number(-1, 1)};
}

TEST(LiquidPoint, TheWeakFormHasTheDerivativeOfCentralDifferences) {
  // Newtonian and power law, with inertia and without, with respect to mesh, velocity and pressure.
  RandomStates random;
  for (const Liquid& liquid : liquids) {
    for (int i = 0; i < states; ++i) {
      const auto error = test::derivative_error<LiquidPoint::inputs>(LiquidPoint{liquid}, liquid_state(random));
      EXPECT_LT(error, test::derivative_tolerance);
    }
  }
}

TEST(CellPoint, TheWeakFormHasTheDerivativeOfCentralDifferences) {
  // All bulk laws, with respect to position and pressure.
  RandomStates random;
  for (const Bulk& bulk : bulks) {
    for (int i = 0; i < states; ++i) {
      const Place<double> reference = random.place();
      const auto error =
          test::derivative_error<CellPoint::inputs>(CellPoint{bulk, reference}, cell_state(random, reference));
      EXPECT_LT(error, test::derivative_tolerance);
    }
  }
}

TEST(LiquidPoint, ALiquidAtRestCarriesPressureAlone) {
  // Fluxes of w = 0 are those of -p I: -p dV/d(r), -p r cof G; no divergence.
  RandomStates random;
  const Liquid liquid{LiquidLaw::power_law, 0.6, 1e-3, 0.8};
  for (int i = 0; i < states; ++i) {
    const Place<double> place = random.place();
    const double p = random.number(-1, 1);
    const auto f = LiquidPoint{liquid}(std::array<double, 12>{place.G(0, 0), place.G(0, 1), place.G(1, 0),
                                                              place.G(1, 1), place.r, 0, 0, 0, 0, 0, 0, p});
    const Flux<double> pressure = pull_back(place, Tensor<double>(-p * Tensor<double>::Identity()));
    EXPECT_NEAR(f[0], 0, rounding);
    EXPECT_NEAR(f[3], -p * place.det, rounding);
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(f[1 + k], pressure.slope(0, k), rounding);
      EXPECT_NEAR(f[4 + k], pressure.slope(1, k), rounding);
    }
    EXPECT_NEAR(f[6], 0, rounding);
  }
}

TEST(CellPoint, TheUndeformedCellExertsNothing) {
  // At x = X and p = 0 all fluxes vanish.
  RandomStates random;
  for (const Bulk& bulk : bulks) {
    const Place<double> X = random.place();
    const std::array<double, 6> at_rest = {X.G(0, 0), X.G(0, 1), X.G(1, 0), X.G(1, 1), X.r, 0};
    for (const double flux : CellPoint{bulk, X}(at_rest)) EXPECT_NEAR(flux, 0, 10 * rounding);
  }
}

TEST(CellPoint, TheFluxIsTheDerivativeOfTheStrainEnergyOfAnIsochoricState) {
  // flux : d(phi) = dW dV0 for a displacement phi that keeps the volume at first order; the pressure does no work.
  RandomStates random;
  for (const Bulk& bulk : bulks) {
    for (int i = 0; i < states; ++i) {
      const Place<double> X = random.place();
      // phi = e (x, -r/2) at the undeformed map scaled isochorically by (l, 1/sqrt(l)).
      const double l = random.number(0.7, 1.4), s = 1 / std::sqrt(l);
      Plane<double> G = X.G;
      G.row(0) *= l;
      G.row(1) *= s;
      const auto flux =
          CellPoint{bulk, X}(std::array<double, 6>{G(0, 0), G(0, 1), G(1, 0), G(1, 1), s * X.r, random.number(-1, 1)});
      const double work = flux[1] * G(0, 0) + flux[2] * G(0, 1) - 0.5 * (flux[3] * s * X.r) -
                          0.5 * (flux[4] * G(1, 0) + flux[5] * G(1, 1));
      const double a = neo_hookean_share(bulk), mu = bulk.shear_modulus;
      const double tension = mu * (a * (l * l - 1 / l) + (1 - a) * (l - 1 / (l * l)));
      EXPECT_NEAR(work, tension * X.volume(), 10 * rounding);
    }
  }
}

}  // namespace
}  // namespace rheocyte
