#include "analytic/effective_modulus.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "laws/derivative.h"

namespace rheocyte::effective_modulus_test {
namespace {

constexpr double rounding = 1e-14;

/// A solid in units of its modulus and radius, which an elastic surface, a tension and a bending stiffness may hold.
double modulus(double E, double surface, double tension = 0, double bending = 0, double poisson_ratio = 0.5) {
  return effective_modulus<double>({E, surface, poisson_ratio, tension, bending, 1});
}

/// The fit of HL60 cells of docs/real-cells.md, in SI units.
double hl60(double tension_N_per_m) {
  return effective_modulus<double>({100, 1.14e-3, 0.5, tension_N_per_m, 0, 6.3e-6});
}

TEST(EffectiveModulus, OfASolidItIsYoungsModulusWhateverItsLaw) {
  EXPECT_NEAR(modulus(1, 0), 1, rounding);
  for (const BulkLaw law : {BulkLaw::linear, BulkLaw::neo_hookean, BulkLaw::mooney_rivlin, BulkLaw::fung})
    for (const double radius_ratio : {0.1, 0.9}) {
      const Media solid{.bulk = {.law = law, .shear_modulus = 7}};
      EXPECT_NEAR(effective_modulus(solid, radius_ratio), 21, 21 * rounding);
    }
}

TEST(EffectiveModulus, OfADropItIsSixTensionsOverItsRadius) {
  EXPECT_DOUBLE_EQ(effective_modulus_of_drop(3.0, 0.0, 2.0), 9);
  const Media drop{.bulk = {.law = BulkLaw::none}, .cortex = {.tension = 3, .bending = 4}};
  EXPECT_DOUBLE_EQ(effective_modulus(drop, 2), 9 + 4.5);  // and nine bending stiffnesses over its cube
}

TEST(EffectiveModulus, OfAMembraneRoundALiquidItIsThreeFifthsOfItsModulusOverTheRadius) {
  // w = 5/3 T r0 / E2D for Poisson's ratio 1/2 (tests/solve/elongation_test.cc); 3 / (4 + 2 nu) in general.
  const Media shell{.bulk = {.law = BulkLaw::none}, .cortex = {.law = CortexLaw::thin_shell, .modulus = 5}};
  EXPECT_NEAR(effective_modulus(shell, 0.5), 6, 6 * rounding);
  for (const double nu : {0.0, 0.2, 0.9}) EXPECT_NEAR(modulus(0, 1, 0, 0, nu), 3 / (4 + 2 * nu), 10 * rounding);
}

TEST(EffectiveModulus, WhereTheSurfaceHasPoissonsRatioOneHalfItHasAShortForm) {
  // eq:effective-modulus-half, by hand from the determinant.
  for (const double E : {0.2, 3.0})
    for (const double a : {0.1, 5.0})
      for (const double g : {0.0, 0.7})
        for (const double b : {0.0, 0.3}) {
          const double short_form =
              (19 * E * E + 95 * E * a + 48 * a * a + (30 * E + 132 * a) * (2 * g + 3 * b)) / (19 * E + 80 * a);
          EXPECT_NEAR(modulus(E, a, g, b) / short_form, 1, 10 * rounding);
        }
}

TEST(EffectiveModulus, AnHL60CellIsMostlyHeldByTheTensionOfItsCortex) {
  // In Pa. Solved at a tension of the surroundings of 5 Pa it was 578, 218 and 102.6.
  EXPECT_NEAR(hl60(0.7e-3), 577.4, 0.05);
  EXPECT_NEAR(hl60(0), 212.5, 0.05);
}

TEST(EffectiveModulus, SkalaksConstantIsThatOfHisPoissonsRatio) {
  const auto cell = [](CortexLaw law, double area_constant) {
    const Media media{.bulk = {.shear_modulus = 1},
                      .cortex = {.law = law, .modulus = 2, .tension = 0.5, .area_constant = area_constant}};
    return effective_modulus(media, 1);
  };
  EXPECT_EQ(cell(CortexLaw::skalak, 1), cell(CortexLaw::neo_hookean_reference, 1));
  EXPECT_NEAR(cell(CortexLaw::skalak, 4), modulus(3, 2, 0.5, 0, 0.8), 10 * rounding);
  EXPECT_LT(cell(CortexLaw::skalak, 4), cell(CortexLaw::skalak, 1));  // at equal E2D it shears more easily
}

TEST(EffectiveModulus, OfAVerySoftCellUnderTensionItIsNotThatOfADrop) {
  // However soft, what holds shear takes up the pull along the surface and passes it on to the shape: 60/19 tensions
  // over the radius in a solid, 33/10 in a membrane, in place of 6 in a drop.
  const double soft = 1e-9;
  EXPECT_NEAR(modulus(soft, 0, 1), 60.0 / 19, 10 * soft);
  EXPECT_NEAR(modulus(0, soft, 1), 3.3, 10 * soft);
}

TEST(EffectiveModulus, ItsDerivativesAreThoseOfAStressThatKnowsNoUnits) {
  // Euler: of degree one in all moduli, and of degree zero in lengths with E2D, gamma and c_b as they scale.
  const std::array<double, 6> cell{1.3, 0.7, 0.6, 0.4, 0.2, 1.7};
  const auto of = [](const auto& x) {
    using T = std::decay_t<decltype(x[0])>;
    return effective_modulus<T>({x[0], x[1], x[2], x[3], x[4], x[5]});
  };
  const auto [value, slope] = value_and_slopes(of, cell);
  EXPECT_NEAR(cell[0] * slope[0] + cell[1] * slope[1] + cell[3] * slope[3] + cell[4] * slope[4], value, 10 * rounding);
  EXPECT_NEAR(cell[1] * slope[1] + cell[3] * slope[3] + 3 * cell[4] * slope[4] + cell[5] * slope[5], 0, 10 * rounding);
  for (std::size_t i = 0; i < cell.size(); ++i) {
    std::array<double, 6> above = cell, below = cell;
    above[i] += 1e-5, below[i] -= 1e-5;
    EXPECT_NEAR(slope[i], (of(above) - of(below)) / 2e-5, 1e-8) << i;
  }
}

TEST(EffectiveModulus, OfACellWithAnotherShapeAtRestThereIsNone) {
  EXPECT_TRUE(std::isnan(effective_modulus(Media{.bulk = {.rest_stretch = 1.1}}, 0.5)));
}

}  // namespace
}  // namespace rheocyte::effective_modulus_test
