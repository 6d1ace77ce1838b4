// The dimensionless groups are those of the theory, and cases with equal groups are one problem.
#include "case/scales.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "case/problem.h"
#include "case/read_case.h"

namespace rheocyte::scales_test {
namespace {

constexpr double rounding = 1e-13;  // a few operations on doubles

Case paper_cell() {
  return parse_case(
      "channel.width_um = 20\nflow.rate_ul_per_s = 0.04\nflow.viscosity_mPas = 15\ncell.radius_um = 7.66\n"
      "cell.bulk.young_modulus_kPa = 3.437\n",
      "paper cell");
}

Case power_law_cell(double exponent, double consistency_Pa_sn) {
  Case c = paper_cell();
  c.flow.law = LiquidLaw::power_law;
  c.flow.viscosity_mPas.reset();
  c.flow.exponent = exponent;
  c.flow.consistency_Pa_sn = consistency_Pa_sn;
  c.flow.shear_rate_floor = 1e-3;
  return c;
}

TEST(Scales, AreTubeRadiusMeanVelocityAndViscousStress) {
  const Scales scales = scales_of(paper_cell());
  const double R = 10.94e-6, U = 0.04e-9 / (std::numbers::pi * R * R);
  EXPECT_NEAR(scales.length_m / R, 1, rounding);
  EXPECT_NEAR(scales.velocity_m_per_s / U, 1, rounding);
  EXPECT_NEAR(scales.stress_Pa / (15e-3 * U / R), 1, rounding);
}

TEST(Scales, AWidthMeansTheTubeOf0547TimesIt) {
  Case c = paper_cell();
  EXPECT_NEAR(tube_radius_um(c), 10.94, 10.94 * rounding);
  c.channel = {.width_um = {}, .radius_um = 10.94};
  EXPECT_EQ(tube_radius_um(c), 10.94);
}

TEST(Scales, OfASquareAreHalfItsWidthAndTheSpeedOverItsArea) {
  Case c = paper_cell();
  c.channel = {.section = Section::square, .width_um = 20, .radius_um = {}};
  const Scales scales = scales_of(c);
  const double h = 1e-5, U = 0.04e-9 / (4 * h * h);
  EXPECT_NEAR(scales.length_m / h, 1, rounding);
  EXPECT_NEAR(scales.velocity_m_per_s / U, 1, rounding);
  EXPECT_NEAR(scales.stress_Pa / (15e-3 * U / h), 1, rounding);
  EXPECT_NEAR(problem_of(c).radius_ratio, 0.766, rounding);
  EXPECT_EQ(problem_of(c).section, Section::square);
}

TEST(Scales, TheGroupsOfThePaperCell) {
  const Problem problem = problem_of(paper_cell());
  const double R = 10.94e-6, U = 0.04e-9 / (std::numbers::pi * R * R), eta = 15e-3, E = 3437;
  EXPECT_NEAR(problem.radius_ratio, 7.66 / 10.94, rounding);
  EXPECT_NEAR(problem.bulk.shear_modulus / (E * R / (3 * eta * U)), 1, rounding);
  EXPECT_NEAR(problem.liquid.reynolds / (1000 * U * R / eta), 1, rounding);
  // Mokbel et al. give rho v_cell R / eta = 0.13 for the standard case; the cell moves at 1.0 to 2.0 U.
  EXPECT_GT(0.13 / problem.liquid.reynolds, 1.0);
  EXPECT_LT(0.13 / problem.liquid.reynolds, 2.0);
  EXPECT_EQ(problem.accuracy, 1e-4);
}

TEST(Scales, TheUndisturbedPressureDropGivesTheSameProblemAsItsRate) {
  // Poiseuille: drop = 8 eta U L / R^2; a power-law liquid: 2 K ((3n+1)/n U)^n L / R^(n+1).
  const double R = 10.94e-6, U = 0.04e-9 / (std::numbers::pi * R * R), L = 100e-6, n = 0.6;
  for (const bool newtonian : {true, false}) {
    const Case given = newtonian ? paper_cell() : power_law_cell(n, 0.4);
    Case driven = given;
    driven.flow.drive = Drive::pressure_drop;
    driven.flow.rate_ul_per_s.reset();
    driven.channel.length_um = 1e6 * L;
    driven.flow.pressure_drop_Pa =
        newtonian ? 8 * 15e-3 * U * L / (R * R) : 2 * 0.4 * std::pow((3 * n + 1) / n * U, n) * L / std::pow(R, n + 1);
    const Scales a = scales_of(given), b = scales_of(driven);
    EXPECT_NEAR(b.velocity_m_per_s / a.velocity_m_per_s, 1, 10 * rounding);
    EXPECT_NEAR(b.stress_Pa / a.stress_Pa, 1, 10 * rounding);
    EXPECT_NEAR(unit_rate_ul_per_s(b), 0.04, 0.04 * 10 * rounding);
    EXPECT_EQ(problem_of(driven).drive, Drive::pressure_drop);
    EXPECT_NEAR(problem_of(driven).channel_length, L / R, 1e-12);
  }
}

TEST(Scales, StokesCasesWithEqualGroupsAreOneProblem) {
  Case one = paper_cell(), other = paper_cell();
  one.flow.density_kg_per_m3 = other.flow.density_kg_per_m3 = 0;
  // Lengths x 2, flow rate x 3, viscosity x 5: the modulus scales by Q eta / R^3 = 15/8 (model of Mokbel et al.).
  other.channel.width_um = 40;
  other.cell.radius_um *= 2;
  *other.flow.rate_ul_per_s *= 3;
  *other.flow.viscosity_mPas *= 5;
  *other.cell.bulk.young_modulus_kPa *= 15.0 / 8;
  const Problem a = problem_of(one), b = problem_of(other);
  EXPECT_NEAR(a.radius_ratio, b.radius_ratio, rounding);
  EXPECT_NEAR(a.bulk.shear_modulus / b.bulk.shear_modulus, 1, rounding);
  EXPECT_EQ(a.liquid.reynolds, 0);
  EXPECT_EQ(b.liquid.reynolds, 0);
}

TEST(Scales, APowerLawWithExponentOneIsNewtonian) {
  const Problem newtonian = problem_of(paper_cell()), power = problem_of(power_law_cell(1, 15e-3));
  EXPECT_NEAR(power.bulk.shear_modulus / newtonian.bulk.shear_modulus, 1, rounding);
  EXPECT_NEAR(power.liquid.reynolds / newtonian.liquid.reynolds, 1, rounding);
}

TEST(Scales, TheStressOfAPowerLawIsKTimesShearRateToTheN) {
  const Scales scales = scales_of(power_law_cell(0.6039, 0.4057));
  const double shear_rate = scales.velocity_m_per_s / scales.length_m;
  EXPECT_NEAR(scales.stress_Pa / (0.4057 * std::pow(shear_rate, 0.6039)), 1, rounding);
}

TEST(Scales, LinearAndNeoHookeanAreTheEndsOfMooneyRivlin) {
  Case c = paper_cell();
  EXPECT_EQ(neo_hookean_fraction(problem_of(c).bulk), 1);
  c.cell.bulk.law = BulkLaw::linear;
  EXPECT_EQ(neo_hookean_fraction(problem_of(c).bulk), 0);
  c.cell.bulk.law = BulkLaw::mooney_rivlin;
  c.cell.bulk.c1_fraction = 0.25;
  EXPECT_EQ(neo_hookean_fraction(problem_of(c).bulk), 0.25);
}

TEST(Scales, TheConstantsOfFungAndSkalakAreThoseOfTheCase) {
  Case c = paper_cell();
  EXPECT_EQ(problem_of(c).cortex.area_constant, 1);
  c.cell.bulk.law = BulkLaw::fung;
  c.cell.bulk.stiffening = 0.7;
  c.cell.cortex.law = CortexLaw::skalak;
  c.cell.cortex.area_constant = 30;
  EXPECT_EQ(problem_of(c).bulk.stiffening, 0.7);
  EXPECT_EQ(problem_of(c).cortex.area_constant, 30);
}

TEST(Scales, AFunnelBecomesTheTubeWithItsMeanSpeeds) {
  // Width x height over the least of it is R^2 over its least at every place; the narrow part is the square channel's
  // tube.
  const WallTable wall = wall_um({{60, 100, 140}, {}, {80, 20, 40}});
  EXPECT_EQ(wall.x.front(), 60);
  EXPECT_EQ(wall.x.back(), 140);
  for (std::size_t i = 0; i < wall.x.size(); ++i) {
    const double x = wall.x[i], width = x < 100 ? 80 - 60 * (x - 60) / 40 : 20 + (x - 100) / 2;
    EXPECT_NEAR(wall.radius[i] * wall.radius[i] / (10.94 * 10.94), width / 20, 1e-12);
  }
  EXPECT_TRUE(wall_um({}).is_straight());
}

TEST(Scales, AFunnelInThreeDimensionsHasItsHalfWidthsOverTheLeast) {
  // In a square the height is the least width; in a rectangle lengths are in half the lesser of both.
  Case c = paper_cell();
  c.channel = {};
  c.channel.section = Section::square;
  c.channel.profile = {{30, 70}, {}, {100, 20}};
  const Problem square = problem_of(c);
  EXPECT_EQ(unit_length_um(c), 10);
  EXPECT_EQ(square.wall.x, (std::vector<double>{3, 7}));
  EXPECT_EQ(square.wall.radius, (std::vector<double>{5, 1}));
  EXPECT_EQ(square.wall.rounding, 0.3);
  c.channel.section = Section::rectangle;
  c.channel.height_um = 10;
  c.channel.profile.rounding_um = 4;
  const Problem flat = problem_of(c);
  EXPECT_EQ(flat.wall.x, (std::vector<double>{6, 14}));
  EXPECT_EQ(flat.wall.radius, (std::vector<double>{5, 1}));
  EXPECT_EQ(flat.wall.rounding, 0.8);
  EXPECT_EQ(flat.extent.width, 2);
  EXPECT_EQ(flat.extent.height, 1);
}

}  // namespace
}  // namespace rheocyte::scales_test
