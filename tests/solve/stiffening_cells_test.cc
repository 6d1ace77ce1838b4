// Cells of laws with a constant of their own: Fung's bulk and Skalak's cortex.
#include <gtest/gtest.h>

#include <cmath>

#include "cases.h"
#include "solve/branch_ends.h"
#include "solve/session.h"
#include "solve/stationary.h"
#include "solve/surface_stability.h"

namespace rheocyte::stiffening_cells_test {
namespace {

/// Newton's tolerance of 1e-10 of the driving forces, some hundred times that in a deformation.
constexpr double tolerance = 1e-8;

Problem fung(double stiffening, double accuracy = 1e-3) {
  Problem problem = test::problem({6, 2.29, 1}, accuracy);
  problem.bulk.law = BulkLaw::fung;
  problem.bulk.stiffening = stiffening;
  return problem;
}

Problem skalak(double area_constant) {
  Problem problem = test::problem({6, 1, 1});
  problem.bulk = {.law = BulkLaw::none};
  problem.cortex = {.law = CortexLaw::skalak, .modulus = 10, .tension = 1, .area_constant = area_constant};
  return problem;
}

StationaryState solved(const Problem& problem) {
  const StationaryState state = solve_stationary(problem);
  EXPECT_EQ(state.outcome.status, Status::converged) << state.outcome.message;
  return state;
}

TEST(FungCell, WithoutStiffeningItIsNeoHookean) {
  const StationaryState fung_cell = solved(fung(0)), neo_hookean = solved(test::problem({6, 2.29, 1}));
  EXPECT_NEAR(fung_cell.shape.deformation / neo_hookean.shape.deformation, 1, tolerance);
  EXPECT_NEAR(fung_cell.cell_velocity, neo_hookean.cell_velocity, tolerance);
  EXPECT_NEAR(fung_cell.stability_margin, neo_hookean.stability_margin, 1e-6);
}

TEST(FungCell, DeformsTheLessTheMoreItStiffens) {
  // And by less compression of the rear, which is farther from a limit that is lower.
  double deformation = HUGE_VAL, margin = 0;
  for (const double stiffening : {0.0, 0.3, 1.0, 3.0}) {
    const StationaryState state = solved(fung(stiffening));
    EXPECT_LT(state.shape.deformation, deformation) << stiffening;
    EXPECT_GT(state.stability_margin, margin) << stiffening;
    deformation = state.shape.deformation;
    margin = state.stability_margin;
  }
}

TEST(FungCell, IsNeoHookeanAsLongAsItIsStiff) {
  // The factor exp(b (I1 - 3)) is of second order in the strain.
  Problem stiff = fung(1, 1e-4);
  stiff.bulk.shear_modulus *= 100;
  Problem neo_hookean = stiff;
  neo_hookean.bulk.law = BulkLaw::neo_hookean;
  EXPECT_NEAR(solved(stiff).shape.deformation / solved(neo_hookean).shape.deformation, 1, 1e-3);
}

TEST(FungCell, ItsStateIsThatOfAFinerMeshWithinTheStatedError) {
  const StationaryState coarse = solved(fung(1, 1e-3)), fine = solved(fung(1, 1e-5));
  EXPECT_LT(fine.estimated_error, 1e-5);
  EXPECT_NE(coarse.shape.deformation, fine.shape.deformation);
  EXPECT_NEAR(coarse.shape.deformation / fine.shape.deformation, 1, coarse.estimated_error + fine.estimated_error);
}

TEST(FungCell, HasStatesBeyondTheEndOfTheNeoHookeanBranch) {
  // With 0.9 of the modulus at which a neo-Hookean cell wrinkles; its limit is lower, or there is none.
  Problem soft = fung(1);
  Problem neo_hookean = soft;
  neo_hookean.bulk.law = BulkLaw::neo_hookean;
  soft.bulk.shear_modulus = 0.9 * min_shear_modulus(neo_hookean).value();
  const StationaryState state = solved(soft);
  EXPECT_GT(state.stability_margin, 0.1);
  EXPECT_LT(std::abs(state.relative_volume_change), 1e-4);
}

TEST(FungCell, InTheSquareItDeformsLessThanANeoHookeanOneAndWithoutStiffeningAsMuch) {
  Problem neo_hookean = test::problem({6, 4.58, 1}, 1e-2);
  neo_hookean.section = Section::square;
  const auto with = [&](double stiffening) {
    Problem problem = neo_hookean;
    problem.bulk.law = BulkLaw::fung;
    problem.bulk.stiffening = stiffening;
    return solved(problem).shape.deformation;
  };
  const double deformation = solved(neo_hookean).shape.deformation;
  EXPECT_NEAR(with(0) / deformation, 1, 1e-6);  // factors in single precision
  EXPECT_LT(with(2), 0.999 * deformation);
}

TEST(SkalakCell, ItsAreaConstantIsThatOfTheState) {
  // Each a shape of its own, and those of two nearly equal constants are nearly equal.
  const double usual = solved(skalak(1)).shape.deformation;
  EXPECT_GT(std::abs(solved(skalak(10)).shape.deformation / usual - 1), 1e-2);
  EXPECT_NEAR(solved(skalak(1 + 1e-6)).shape.deformation / usual, 1, 1e-5);
}

TEST(StiffeningCells, ASessionSeesTheirConstants) {
  // A session goes on from the last state: to another constant as from the sphere.
  Session session;
  for (const Problem& problem : {fung(1), fung(1.1), fung(3), skalak(1), skalak(1.05), skalak(5)})
    EXPECT_NEAR(session.solve(problem).shape.deformation / solved(problem).shape.deformation, 1, 1e-6);
}

}  // namespace
}  // namespace rheocyte::stiffening_cells_test
