#include "laws/weak_form.h"

#include <gtest/gtest.h>

#include <set>

#include "derivative_error.h"
#include "laws/moving_form.h"
#include "laws/split_form.h"
#include "laws/surface_form.h"
#include "random_states.h"

namespace rheocyte::weak_form_test {
namespace {

using test::RandomStates;
using test::states;

// Some dozen operations on stresses of order ten.
constexpr double rounding = 1e-12;

const std::array liquids = {Liquid{}, Liquid{LiquidLaw::newtonian, 1, 0, 0.8},
                            Liquid{LiquidLaw::power_law, 0.6, 0.1, 0}, Liquid{LiquidLaw::power_law, 0.6, 0.1, 0.8},
                            Liquid{LiquidLaw::carreau, 0.5, 0, 0.8, 3, 0.2, 2, 1.5}};
constexpr std::array bulks = {Bulk{BulkLaw::linear, 12}, Bulk{BulkLaw::neo_hookean, 12},
                              Bulk{BulkLaw::mooney_rivlin, 12, 0.4},
                              Bulk{.law = BulkLaw::fung, .shear_modulus = 12, .stiffening = 0.8}};

template <class T>
using Liquid2 = LiquidFields<T, 2>;
template <class T>
using Cell2 = CellFields<T, 2>;

std::array<double, Liquid2<double>::count> liquid_state(RandomStates& random) {
  std::array<double, Liquid2<double>::count> numbers;
  auto fields = read_fields<Liquid2<double>>([&](int) { return random.number(-1, 1); });
  fields.map = random.map();
  fields.w_xi(0, 1) += 2;  // never near zero shear rate, where differences of the power law fail
  int i = 0;
  fields.visit([&](const Input&, double number) { numbers[i++] = number; });
  return numbers;
}

std::array<double, Cell2<double>::count> cell_state(RandomStates& random, const PointMap<double, 2>& undeformed) {
  const Slopes<double, 2> G = undeformed.G + 0.3 * random.element_map() - 0.3 * Slopes<double, 2>::Identity();
  return {G(0, 0), G(0, 1), G(1, 0), G(1, 1), undeformed.r * random.number(0.8, 1.2), random.number(-1, 1)};
}

TEST(LiquidPoint, TheWeakFormHasTheDerivativeOfCentralDifferences) {
  // Newtonian and power law, with inertia and without, with respect to mesh, velocity and pressure.
  RandomStates random;
  for (const Liquid& liquid : liquids) {
    for (int i = 0; i < states; ++i) {
      const auto form = test::numberwise<Liquid2>(LiquidPoint<2>{liquid});
      EXPECT_LT(test::derivative_error(form, liquid_state(random)), test::derivative_tolerance);
    }
  }
}

TEST(CellPoint, TheWeakFormHasTheDerivativeOfCentralDifferences) {
  // All bulk laws, with respect to position and pressure.
  RandomStates random;
  for (const Bulk& bulk : bulks) {
    for (int i = 0; i < states; ++i) {
      const PointMap<double, 2> undeformed = random.map();
      const auto form = test::numberwise<Cell2>(CellPoint<2>{bulk, undeformed});
      EXPECT_LT(test::derivative_error(form, cell_state(random, undeformed)), test::derivative_tolerance);
    }
  }
}

TEST(Fields, EachNumberIsListedOnce) {
  // The numbers of a structure are as many as it says, and no two are fed by the same part of the same component.
  const auto listed = [](const std::vector<Input>& inputs) {
    std::set<std::array<int, 3>> different;
    for (const Input& input : inputs) different.insert({int(input.source), input.component, input.part});
    EXPECT_EQ(different.size(), inputs.size());
    return int(inputs.size());
  };
  EXPECT_EQ(listed(inputs_of<Liquid2<double>>()), Liquid2<double>::count);
  EXPECT_EQ(listed(inputs_of<Cell2<double>>()), Cell2<double>::count);
  EXPECT_EQ(listed(inputs_of<MovingLiquidFields<double>>()), MovingLiquidFields<double>::count);
  EXPECT_EQ(listed(inputs_of<MovingCellFields<double, 2>>()), (MovingCellFields<double, 2>::count));
  EXPECT_EQ(listed(inputs_of<MovingCellFields<double, 3>>()), (MovingCellFields<double, 3>::count));
  EXPECT_EQ(listed(inputs_of<SplitCellFields<double>>()), SplitCellFields<double>::count);
  EXPECT_EQ(listed(inputs_of<SurfaceFields<double>>()), SurfaceFields<double>::count);
  EXPECT_EQ(listed(inputs_of<SurfaceFlux<double>>()), SurfaceFlux<double>::count);
  EXPECT_EQ(listed(inputs_of<KinkFields<double>>()), KinkFields<double>::count);
}

TEST(LiquidPoint, ALiquidAtRestCarriesPressureAlone) {
  // Fluxes of w = 0 are those of -p I: -p dV/d(r), -p r cof G; no divergence.
  RandomStates random;
  const Liquid liquid{LiquidLaw::power_law, 0.6, 1e-3, 0.8};
  for (int i = 0; i < states; ++i) {
    const PointMap<double, 2> map = random.map();
    const double p = random.number(-1, 1);
    const auto flux =
        LiquidPoint<2>{liquid}(Liquid2<double>{map, Components<double, 2>::Zero(), Slopes<double, 2>::Zero(), p});
    const Flux<double, 2> pressure = pull_back(map, Tensor<double>(-p * Tensor<double>::Identity()));
    EXPECT_LT((flux.value - Components<double, 2>(0, -p * map.det)).norm(), rounding);
    EXPECT_LT((flux.slope - pressure.slope).norm(), rounding);
    EXPECT_NEAR(flux.pressure, 0, rounding);
  }
}

TEST(CellPoint, TheUndeformedCellExertsNothing) {
  // At x = X and p = 0 all fluxes vanish.
  RandomStates random;
  for (const Bulk& bulk : bulks) {
    const PointMap<double, 2> X = random.map();
    CellPoint<2>{bulk, X}(Cell2<double>{X, 0}).visit([](double flux) { EXPECT_NEAR(flux, 0, 10 * rounding); });
  }
}

TEST(CellPoint, TheFluxIsTheDerivativeOfTheStrainEnergyOfAnIsochoricState) {
  // flux : d(phi) = dW dV0 for a displacement phi that keeps the volume at first order; the pressure does no work.
  RandomStates random;
  for (const Bulk& bulk : bulks) {
    for (int i = 0; i < states; ++i) {
      const PointMap<double, 2> X = random.map();
      // phi = e (x, -r/2) at the undeformed map scaled isochorically by (l, 1/sqrt(l)).
      const double l = random.number(0.7, 1.4), s = 1 / std::sqrt(l);
      const Slopes<double, 2> G{l * X.G(0, 0), l * X.G(0, 1), s * X.G(1, 0), s * X.G(1, 1)};
      const Slopes<double, 2> slope{G(0, 0), G(0, 1), -0.5 * G(1, 0), -0.5 * G(1, 1)};
      const auto flux = CellPoint<2>{bulk, X}(Cell2<double>{{G, s * X.r}, random.number(-1, 1)});
      const double work = dot(flux.slope, slope) - 0.5 * (flux.value(1) * s * X.r);
      const double a = neo_hookean_fraction(bulk), mu = bulk.shear_modulus;
      const double factor = bulk.law == BulkLaw::fung ? std::exp(bulk.stiffening * (l * l + 2 / l - 3)) : 1;
      const double tension = mu * factor * (a * (l * l - 1 / l) + (1 - a) * (l - 1 / (l * l)));
      EXPECT_NEAR(work, tension * X.volume(), 10 * rounding);
    }
  }
}

}  // namespace
}  // namespace rheocyte::weak_form_test
