// Cells off the axis of a duct in time: they turn, and drift towards the axis (docs/theory-time.md,
// eq:turning-in-time).
#include <gtest/gtest.h>

#include <cmath>

#include "solve/duct.h"
#include "solve/stationary.h"
#include "solve/time_stepper.h"
#include "solve/transient.h"

namespace rheocyte::off_axis_in_time_test {
namespace {

/// 6 um where h is 10 um and S 150 Pa.
Problem cell_at(double offset, double young_modulus_Pa) {
  Problem problem;
  problem.section = Section::square;
  problem.camera = {90};
  problem.radius_ratio = 0.6;
  problem.bulk.shear_modulus = young_modulus_Pa / 3 / 150;
  problem.offset = offset;
  problem.accuracy = 1e-2;
  return problem;
}

constexpr Resolution coarse{{}, 3};

TimeStepOptions with_accuracy(double accuracy) {
  return {.accuracy = accuracy, .newton = {.tolerance = 1e-7, .keep_factors = true, .chord_limit = 15}};
}

struct Place {
  double offset, drift, spin, deformation;
};

Place place_of(const TimeStepper& stepper) {
  const StateNumbers numbers = stepper.discrete().numbers(stepper.problem(), stepper.now().unknowns);
  return {numbers.offset, numbers.drift_velocity, numbers.spin, numbers.shape.deformation};
}

void follow(TimeStepper& stepper, double end) {
  ASSERT_EQ(stepper.start(), Status::converged);
  while (stepper.now().time < end) ASSERT_EQ(stepper.step(end).status, Status::converged);
}

/// The stationary state whose barycentre is at a place; a mesh gets the place of the node that is fixed.
StateNumbers stationary_at(double offset, double young_modulus_Pa) {
  StateNumbers numbers;
  double held = offset;
  for (int round = 0; round < 4; ++round) {
    const Problem problem = cell_at(held, young_modulus_Pa);
    const auto discrete = duct_geometry(problem).make(problem, coarse);
    VectorXd state = discrete->system().sphere();
    EXPECT_EQ(newton(discrete->system(), problem, {.tolerance = 1e-9}, state).status, Status::converged);
    numbers = discrete->numbers(problem, state);
    held += offset - numbers.offset;
  }
  EXPECT_NEAR(numbers.offset, offset, 1e-5);
  return numbers;
}

TEST(OffAxisInTime, WhatHasSettledDriftsAsTheStationaryStateOfItsPlace) {
  // The stiffer a cell, the faster it adapts and the slower it drifts: what it lags behind falls as 1/E^2 (3.5 % of the
  // drift at 10 kPa).
  TimeStepper stepper(cell_at(0.2, 4e4), coarse, with_accuracy(2e-5));
  follow(stepper, 2);
  const Place now = place_of(stepper);
  EXPECT_LT(now.offset, 0.2);
  const StateNumbers stationary = stationary_at(now.offset, 4e4);
  EXPECT_NEAR(now.drift / stationary.drift_velocity, 1, 5e-3);
  EXPECT_NEAR(now.spin / stationary.spin, 1, 2e-3);
  EXPECT_NEAR(now.deformation / stationary.shape.deformation, 1, 5e-3);
}

TEST(OffAxisInTime, BothSidesOfTheAxisMirrorEachOther) {
  // To what steps of equal size, a tolerance of 1e-7 and factors in single precision leave.
  const auto at_end = [](double offset) {
    TimeStepper stepper(cell_at(offset, 2e3), coarse, with_accuracy(1e-3));
    follow(stepper, 0.3);
    return place_of(stepper);
  };
  const Place above = at_end(0.2), below = at_end(-0.2);
  EXPECT_NEAR(above.offset, -below.offset, 1e-6);
  EXPECT_NEAR(above.spin, -below.spin, 1e-5);
  EXPECT_NEAR(above.deformation, below.deformation, 1e-6);
}

TEST(OffAxisInTime, ASoftInteriorThatIsMoreViscousThanTheLiquidIsFollowed) {
  // Its viscous stress is twenty times the elastic one, so that the spin decides that of its velocity: with the spin of
  // the steps before in it steps became ever shorter, and the cell turned backwards.
  Problem problem = cell_at(0.2, 0);
  problem.bulk.shear_modulus = 0.5;
  problem.bulk.viscosity = 6;
  problem.cortex = {.law = CortexLaw::neo_hookean, .modulus = 1.75, .tension = 1.1};
  TimeStepper stepper(problem, {{}, 2}, with_accuracy(3e-3));
  ASSERT_EQ(stepper.start(), Status::converged);
  int steps = 0;
  for (; stepper.now().time < 6 && steps < 40; ++steps) ASSERT_EQ(stepper.step(6).status, Status::converged);
  EXPECT_LT(steps, 40);
  const Place now = place_of(stepper);
  EXPECT_LT(now.offset, 0.18);
  EXPECT_GT(now.offset, 0);
  EXPECT_GT(now.spin, 0);
}

TEST(OffAxisInTime, AShortMemoryIsAViscosityAndALongOneAModulus) {
  // A branch that forgets a hundred times faster than the cell turns, and one that forgets nothing.
  const auto at_end = [](double shear_modulus, double viscosity, double branch_modulus) {
    Problem problem = cell_at(0.2, 0);
    problem.bulk = {.law = BulkLaw::neo_hookean, .shear_modulus = shear_modulus, .viscosity = viscosity};
    problem.bulk.branch_modulus = branch_modulus;
    TimeStepper stepper(problem, coarse, with_accuracy(1e-3));
    follow(stepper, 1);
    return place_of(stepper);
  };
  const auto expect_alike = [](const Place& a, const Place& b, double tolerance) {
    EXPECT_NEAR(a.offset, b.offset, tolerance * b.offset);
    EXPECT_NEAR(a.spin, b.spin, tolerance * b.spin);
    EXPECT_NEAR(a.deformation, b.deformation, tolerance * b.deformation);
  };
  expect_alike(at_end(9, 3, 300), at_end(9, 3, 0), 1e-2);
  expect_alike(at_end(5, 1e6, 4), at_end(9, 0, 0), 5e-3);
}

TEST(OffAxisInTime, NearTheAxisOfAFunnelItIsAsOnTheAxis) {
  // On the mesh of another symmetry and other elements: both have an error of some per cent at degree 3.
  const WallTable wall{{0.5, 1.5}, {2, 1}, 0.3};
  Problem problem = cell_at(2e-3, 4e3);
  problem.wall = wall;
  TimeStepper beside(problem, coarse, with_accuracy(1e-3));
  follow(beside, 1.5);
  problem.offset = 0;
  TimeStepper on(problem, coarse, with_accuracy(1e-3));
  follow(on, 1.5);
  EXPECT_NEAR(beside.now().place(), on.now().place(), 2e-3 * on.now().place());
  EXPECT_NEAR(place_of(beside).deformation / place_of(on).deformation, 1, 0.05);
}

}  // namespace
}  // namespace rheocyte::off_axis_in_time_test
