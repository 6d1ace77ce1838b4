#include "solve/partitioned_stepper.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cases.h"
#include "fem/observe.h"
#include "shape/measures.h"
#include "solve/time_stepper.h"

namespace rheocyte::partitioned_stepper_test {
namespace {

constexpr double unit_us = 102.835;  // R/U of cases.h

Problem moving_cell() {
  Problem problem = test::problem({7.66, 3.437, 0}, 1e-4);
  problem.liquid.reynolds = problem.bulk.reynolds = 0.0776;
  problem.bulk.viscosity = 1;
  return problem;
}

const Resolution resolution{{2, 4, 1, 2}, 3};

ShapeMeasures shape_at(const Stepper& stepper, double time) {
  return measure(contour(stepper.space(), stepper.level_at(time).unknowns));
}

TEST(PartitionedStepper, AgreesWithTheImplicitStepsAtAllTimes) {
  // With the paper's step of 0.2 us: d within 2 % of the final one, 0.043, and the volume within the paper's 2e-3.
  PartitionedStepper split(moving_cell(), resolution, {0.2 / unit_us});
  TimeStepper implicit(moving_cell(), resolution, {});
  ASSERT_EQ(split.start(), Status::converged);
  ASSERT_EQ(implicit.start(), Status::converged);
  const double volume = shape_at(split, 0).volume;
  for (int k = 1; k <= 8; ++k) {
    const double time = 5 * k / unit_us;
    while (split.now().time < time * (1 - 1e-9)) ASSERT_EQ(split.step(time).status, Status::converged);
    while (implicit.now().time < time * (1 - 1e-9)) ASSERT_EQ(implicit.step(time).status, Status::converged);
    EXPECT_NEAR(shape_at(split, time).deformation, shape_at(implicit, time).deformation, 0.02 * 0.043);
    EXPECT_NEAR(shape_at(split, time).volume / volume, 1, 2e-3);
  }
}

TEST(PartitionedStepper, TheControllerReachesTheWantedFlowRate) {
  // Mokbel et al. adapt the pressure drop in each step: after 40 us the flow rate is the wanted one within 1e-3, and
  // the shape on the way is that of the given rate within 1 % of the final one.
  Problem controlled = moving_cell();
  controlled.drive = Drive::controlled_pressure;
  PartitionedStepper one(controlled, resolution, {0.2 / unit_us}), other(moving_cell(), resolution, {0.2 / unit_us});
  ASSERT_EQ(one.start(), Status::converged);
  ASSERT_EQ(other.start(), Status::converged);
  EXPECT_LT(flow_rate(one.space(), one.now().unknowns), 0.97);  // the cell is in the way
  const double end = 40 / unit_us;
  while (one.now().time < end * (1 - 1e-9)) {
    ASSERT_EQ(one.step(end).status, Status::converged);
    ASSERT_EQ(other.step(end).status, Status::converged);
    EXPECT_NEAR(shape_at(one, one.now().time).deformation, shape_at(other, other.now().time).deformation, 0.01 * 0.043);
  }
  EXPECT_NEAR(flow_rate(one.space(), one.now().unknowns), 1, 1e-3);
}

TEST(PartitionedStepper, ItsErrorFallsInProportionToTheStep) {
  // Explicit in the elasticity: order 1 within 0.1, from d at 10 us for steps of 0.2, 0.1, 0.05 us.
  double values[3];
  for (int k = 0; k < 3; ++k) {
    PartitionedStepper split(moving_cell(), resolution, {0.2 / (1 << k) / unit_us});
    ASSERT_EQ(split.start(), Status::converged);
    while (split.now().time < 10 / unit_us * (1 - 1e-9)) ASSERT_EQ(split.step(10 / unit_us).status, Status::converged);
    values[k] = shape_at(split, 10 / unit_us).deformation;
  }
  EXPECT_NEAR(std::log2((values[1] - values[0]) / (values[2] - values[1])), 1, 0.1);
}

TEST(PartitionedStepper, ATooLargeStepIsANamedFailureAndKeepsTheState) {
  // Explicit elasticity has a limit: with steps of 50 us the shape is lost within a few of them.
  PartitionedStepper split(moving_cell(), resolution, {50 / unit_us});
  ASSERT_EQ(split.start(), Status::converged);
  Status status = Status::converged;
  for (int i = 0; i < 50 && status == Status::converged; ++i) status = split.step(1e9).status;
  EXPECT_NE(status, Status::converged);
  EXPECT_TRUE(split.now().unknowns.allFinite());
}

TEST(PartitionedStepper, ResumingASavedStateChangesNothing) {
  // The relaxed traction belongs to the state: same bits.
  PartitionedStepper one(moving_cell(), resolution, {0.2 / unit_us}), other(moving_cell(), resolution, {0.2 / unit_us});
  ASSERT_EQ(one.start(), Status::converged);
  for (int i = 0; i < 5; ++i) one.step(1);
  other.resume(one.state());
  one.step(1);
  other.step(1);
  EXPECT_EQ(one.now().unknowns, other.now().unknowns);
}

}  // namespace
}  // namespace rheocyte::partitioned_stepper_test
