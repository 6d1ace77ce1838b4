// The effective modulus in closed form is that of solved cells in the limit of no load (docs/theory-analytic.md,
// eq:effective-modulus).
#include "analytic/effective_modulus.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "solve/session.h"

namespace rheocyte::effective_modulus_test {
namespace {

/// Moduli over the stress of the flow, which is as good as none.
constexpr double stiff = 1e6;

/// 3 T / (4 c_2) for T -> 0, extrapolated from tensions that elongate and shorten the cell by 1 and 2 %: central
/// differences, whose error is even in the tension.
double solved_modulus(Problem cell) {
  const double tension = 0.01 * effective_modulus(cell, cell.radius_ratio);
  Session session;
  const auto elongation = [&](double T) {
    axial_tension(cell) = T;
    const StationaryState state = session.solve(cell);
    EXPECT_EQ(state.outcome.status, Status::converged) << state.outcome.message;
    return state.shape.modes[2 - first_radius_mode];
  };
  const auto compliance = [&](double T) { return (elongation(T) - elongation(-T)) / (2 * T); };
  return 0.75 * 3 / (4 * compliance(tension) - compliance(2 * tension));
}

/// A cell with bulk, cortex, tension and bending; its number chooses the laws.
Problem random_cell(std::mt19937& random, int number) {
  constexpr BulkLaw bulks[] = {BulkLaw::neo_hookean, BulkLaw::linear,      BulkLaw::mooney_rivlin,
                               BulkLaw::fung,        BulkLaw::neo_hookean, BulkLaw::none};
  constexpr CortexLaw cortices[] = {CortexLaw::neo_hookean, CortexLaw::neo_hookean_reference, CortexLaw::skalak,
                                    CortexLaw::linear, CortexLaw::thin_shell};
  std::uniform_real_distribution<double> unit(0, 1);
  Problem cell;
  const double r0 = cell.radius_ratio = 0.3 + 0.5 * unit(random);
  cell.bulk.law = bulks[number % 6];
  cell.cortex.law = cortices[number % 5];
  const double part = cell.bulk.law == BulkLaw::none ? 1 : unit(random);
  cell.bulk.shear_modulus = cell.bulk.law == BulkLaw::none ? 0 : stiff * (1 - part) / 3;
  cell.cortex.modulus = stiff * part * r0;
  const double tension = unit(random), bending = std::pow(10, -4 + 3 * unit(random));
  // Without bulk and tension a surface that is compressed wrinkles.
  const bool is_slack = number % 4 == 3 && cell.bulk.law != BulkLaw::none;
  cell.cortex.tension = is_slack ? 0 : stiff * (0.05 + tension) * r0;
  cell.cortex.bending = number % 7 == 3 ? 0 : stiff * bending * r0 * r0 * r0;
  cell.cortex.area_constant = std::pow(10, -1 + 2.5 * unit(random));
  cell.accuracy = is_slack ? 1e-4 : 1e-3;  // what is slack needs finer meshes
  return cell;
}

/// Greatest relative difference over so many cells.
double greatest_difference(Section section, int cells) {
  std::mt19937 random(7);
  double greatest = 0;
  for (int i = 0; i < cells; ++i) {
    Problem cell = random_cell(random, i);
    cell.section = section;
    // Stiff surfaces take long in ducts, and the stiffest are refused there (case/check_duct.cc).
    if (section == Section::square) cell.cortex.bending *= 1e-3;
    const double difference = solved_modulus(cell) / effective_modulus(cell, cell.radius_ratio) - 1;
    greatest = std::max(greatest, std::abs(difference));
  }
  std::printf("%d cells: at most %.1e\n", cells, greatest);
  return greatest;
}

TEST(EffectiveModulus, IsThatOfSolvedCells) { EXPECT_LT(greatest_difference(Section::tube, 8), 1e-5); }

TEST(EffectiveModulus, InTheSquareItIsTheSame) { EXPECT_LT(greatest_difference(Section::square, 1), 1e-4); }

TEST(EffectiveModulusSlow, IsThatOfThirtySolvedCells) {
  // 1.6e-5, of the fourth order in the strain: a Skalak cortex that nothing holds taut. The others are within 2e-6.
  EXPECT_LT(greatest_difference(Section::tube, 30), 3e-5);
}

TEST(EffectiveModulusSlow, InTheSquareItIsThatOfThirtySolvedCells) {
  EXPECT_LT(greatest_difference(Section::square, 30), 1e-4);  // 2.4e-5, of the same cell
}

}  // namespace
}  // namespace rheocyte::effective_modulus_test
