// A cell in a channel that is not straight.
#include <gtest/gtest.h>

#include <cmath>

#include "cases.h"
#include "fem/moving_system.h"
#include "fem/observe.h"
#include "laws/developed_flow.h"
#include "shape/measures.h"
#include "solve/rigid_start.h"
#include "solve/time_stepper.h"
#include "solve/transient.h"

namespace rheocyte::channel_entry_test {
namespace {

constexpr double unit_us = 102.835;  // R/U of cases.h, R that of the narrow tube

/// A cell of 7 um that starts 4 R before a contraction from 2 R to R.
Problem entering_cell(double c1_fraction = 1) {
  Problem problem = test::problem({7, 4.58, c1_fraction}, 1e-5);
  problem.liquid.reynolds = problem.bulk.reynolds = 0.0776;
  problem.bulk.viscosity = 1;
  problem.wall = {{4, 8}, {2, 1}};
  return problem;
}

Resolution resolution(int degree) { return {{2, 4, 1, 2}, degree}; }

ShapeMeasures shape(const TimeStepper& stepper) { return measure(contour(stepper.space(), stepper.now().unknowns)); }

/// Flow rate in the laboratory through the outlet, in pi R^2 U.
double outflow(const TimeStepper& stepper) {
  const Discretisation& space = stepper.space();
  const ReferenceElement<2>& reference = space.reference();
  const MatrixXd value = reference.lagrange(reference.points_1d);
  const VectorXd& x = stepper.now().unknowns;
  double rate = 0;
  for (const BoundaryEdge& edge : space.outlet()) {
    VectorXd r(edge.nodes.size()), v(edge.nodes.size());
    for (int k = 0; k < r.size(); ++k) {
      r(k) = space.node_points()[edge.nodes[k]](1);
      v(k) = space.velocity(edge.nodes[k], 0).value(x) + x(space.cell_velocity());
    }
    rate += 2 * (r.maxCoeff() - r.minCoeff()) * reference.weights_1d.dot(VectorXd((value * r).cwiseProduct(value * v)));
  }
  return rate;
}

double drop_between_ends(const Discretisation& space, const VectorXd& unknowns) {
  return end_pressure(space, unknowns, ChannelEnd::upstream) - end_pressure(space, unknowns, ChannelEnd::downstream);
}

/// Pressure drop over the channel round a sphere at rest at x = 0, with a mesh that goes on beyond by `run_out`.
double drop_round_sphere(const Problem& problem, double run_out) {
  const ChannelMesh mesh(ChannelGeometry(problem.radius_ratio, 0, run_out), {2, 4, 1, 2});
  Discretisation space(mesh, 6, problem.liquid);
  MovingSystem system(space);
  const WallProfile wall(problem.wall);
  const VectorXd nothing = VectorXd::Zero(space.unknowns());
  const VectorXd outward = space.wall_motion([&](double x) { return wall.radius(x); }, nothing);
  space.move_nodes(outward);
  system.set_motion({0, nothing, VectorXd::Zero(2 * space.nodes().count), VectorXd::Zero(outward.size())});
  VectorXd unknowns;
  EXPECT_EQ(flow_round_sphere(system, problem, {.tolerance = 1e-9}, unknowns), Status::converged);
  return drop_between_ends(space, unknowns);
}

TEST(ChannelEntry, AnEndOnASlopeDoesNotChangeThePressureDrop) {
  // Against a mesh whose ends are straight, within 1.5e-3 of the drop, which is the error of the coarse mesh along the
  // steepest wall; with the ends of the mesh on the slope the drop was 5e-3 to 7e-2 too large.
  Problem problem = entering_cell();
  problem.liquid.reynolds = problem.bulk.reynolds = 0;
  const double half = min_half_length(problem.radius_ratio);
  for (const double steepness : {0.1, 0.3, 0.5}) {
    const double length = 1 / steepness;
    // The ends of the channel lie in the middle of the slope, the one behind a contraction, the other before it.
    for (const double centre : {half, -half}) {
      problem.wall = {{centre - length / 2, centre + length / 2}, {2, 1}};
      const double drop = drop_round_sphere(problem, 12);
      EXPECT_NEAR(drop_round_sphere(problem, run_out(problem.wall)) / drop, 1, 1.5e-3);
    }
  }
}

TEST(ChannelEntry, AProfileOfOneRadiusChangesNothing) {
  // Against the straight channel: surface and velocity agree to rounding (1e-11) after steps of fixed size.
  Problem straight = entering_cell(), constant = straight;
  straight.wall = {};
  constant.wall = {{-1, 0.5, 2}, {1, 1, 1}};
  const TimeStepOptions options{.max_order = 3, .fixed_step = 0.02, .newton = {1e-13}};
  TimeStepper one(straight, resolution(4), options), other(constant, resolution(4), options);
  ASSERT_EQ(one.start(), Status::converged);
  ASSERT_EQ(other.start(), Status::converged);
  for (int i = 0; i < 12; ++i) {
    ASSERT_EQ(one.step(1e9).status, Status::converged);
    ASSERT_EQ(other.step(1e9).status, Status::converged);
  }
  EXPECT_LT((one.now().unknowns - other.now().unknowns).lpNorm<Eigen::Infinity>(), 1e-9);
  EXPECT_NEAR(shape(one).deformation, shape(other).deformation, 1e-11);
  EXPECT_GT(shape(one).deformation, 0.004);
  EXPECT_NEAR(one.now().position / other.now().position, 1, 1e-12);
}

TEST(ChannelEntry, InTheWideTubeThePressureDropIsThatOfTheWideTube) {
  // A sixteenth of the narrow tube's (Hagen and Poiseuille), and what the small cell adds, which is below 3 %.
  const Problem problem = entering_cell();
  TimeStepper stepper(problem, resolution(4), {.fixed_step = 0.02});
  ASSERT_EQ(stepper.start(), Status::converged);
  for (int i = 0; i < 3; ++i) ASSERT_EQ(stepper.step(1e9).status, Status::converged);
  const Discretisation& space = stepper.space();
  const double half = space.mesh().geometry().half_length();
  ASSERT_LT(half, 3.9) << "the contraction is out of sight";
  const double drop = drop_between_ends(space, stepper.now().unknowns);
  EXPECT_NEAR(drop / (undisturbed_pressure_gradient(problem.liquid) * 2 * half / 16), 1.015, 0.015);
}

TEST(ChannelEntry, NoLiquidIsLostAndTheEndStateIsThatOfTheNarrowTube) {
  // At every step the outlet passes what the inlet takes in, but for the error with which the formula differentiates
  // the motion of the cell (4e-5 here), and the cell keeps its volume. Far behind the contraction d is the stationary
  // solver's within 1e-3 of it.
  Problem problem = entering_cell();
  TimeStepper stepper(problem, resolution(4), {.accuracy = 1e-4});
  ASSERT_EQ(stepper.start(), Status::converged);
  const double volume = shape(stepper).volume;
  double greatest = 0;
  while (stepper.now().position < 40) {
    ASSERT_EQ(stepper.step(1e9).status, Status::converged);
    EXPECT_NEAR(outflow(stepper), 1, 2e-4);
    EXPECT_NEAR(shape(stepper).volume / volume, 1, 1e-8);
    greatest = std::max(greatest, shape(stepper).deformation);
  }
  problem.wall = {};
  const StationaryState stationary = solve_stationary(problem);
  EXPECT_NEAR(shape(stepper).deformation / stationary.shape.deformation, 1, 1e-3);
  EXPECT_NEAR(stepper.now().unknowns(stepper.space().cell_velocity()) / stationary.cell_velocity, 1, 1e-4);
  EXPECT_GT(greatest, 1.02 * stationary.shape.deformation);  // overshoot
}

TEST(ChannelEntry, ARigidSphereMovesAsInTheStraightChannelOfItsPlace) {
  // Nearly rigid, and slowly widening walls: v_cell R_w^2 is that of the straight tube within the slope, 1 %.
  Problem problem = test::problem({3, 1e4, 1}, 1e-4);
  problem.wall = {{0, 300}, {1.3, 1}};
  TimeStepper stepper(problem, resolution(3), {.accuracy = 1e-3});
  ASSERT_EQ(stepper.start(), Status::converged);
  const auto velocity = [&] { return stepper.now().unknowns(stepper.space().cell_velocity()); };
  const double at_start = velocity();
  EXPECT_NEAR(at_start * 1.69, 1.97, 0.03);  // twice the mean speed on the axis, less 2/3 (r0/R)^2
  while (stepper.now().position < 10) ASSERT_EQ(stepper.step(1e9).status, Status::converged);
  EXPECT_NEAR(velocity() / at_start, 1, 0.01);
}

TEST(ChannelEntry, EndsAndOutputsByPlaceAreMet) {
  // Outputs at every R and the end at 2.5 R, to rounding of the place; the way between them is that of the run by time:
  // the place, interpolated there at the time of an output, is the output's within the error of the steps.
  const Problem problem = entering_cell();
  std::vector<double> times, places;
  const auto see = [&](const TimeFrame& frame) {
    times.push_back(frame.time);
    places.push_back(frame.position);
  };
  TimeRun run{HUGE_VAL, 1, 1e-3, 3};
  run.end_position = 2.5;
  run.outputs_by_place = true;
  ASSERT_EQ(transient(problem, run, {see, {}}).outcome.status, Status::converged);
  ASSERT_EQ(places.size(), 4u);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(places[i], std::min(1.0 * i, 2.5), 1e-9);
  const double end = times.back();
  ASSERT_EQ(transient(problem, {end, 1e9, 1e-3, 3}, {see, {}}).outcome.status, Status::converged);
  EXPECT_NEAR(places.back(), 2.5, 1e-6);
}

TEST(ChannelEntry, ARunEndsWhenTheCellHasSettledBehindTheWalls) {
  // Long before the time is over; at no place before the walls, where the sphere hardly changes either.
  Problem problem = entering_cell();
  double end = 0, position = 0;
  const auto see = [&](const TimePoint& point, const TimeState&) { end = point.time, position = point.position; };
  const StationaryState state = transient(problem, {500, 1e9, 1e-3, 3}, {{}, see});
  ASSERT_EQ(state.outcome.status, Status::converged);
  EXPECT_LT(end, 400);
  EXPECT_GT(position, 8);
  problem.wall = {};
  // The mesh is coarse (degree 3): 1 %.
  EXPECT_NEAR(state.shape.deformation / solve_stationary(problem).shape.deformation, 1, 0.01);
}

TEST(ChannelEntry, AStretchedStandardLinearSolidIsFollowedWhileItsWavesFade) {
  // Its viscosity, in series with a spring, does not damp short waves. Formulas of higher order amplified them until,
  // at 0.4 R/U, no step succeeded.
  Problem problem = entering_cell();
  problem.bulk.branch_modulus = 2 * problem.bulk.shear_modulus;
  problem.bulk.viscosity = 7;
  problem.start_stretch = 1.2;
  EXPECT_EQ(transient(problem, {0.6, 1e9, 1e-5, 5}, {}).outcome.status, Status::converged);
}

TEST(ChannelEntry, ACellPassesAWallOf45Degrees) {
  // And a contraction of that kind from five times the radius; both end as the stationary cell within 1e-3.
  Problem problem = entering_cell(), straight = problem;
  straight.wall = {};
  const double stationary = solve_stationary(straight).shape.deformation;
  for (const WallTable& wall : {WallTable{{4, 5}, {2, 1}}, WallTable{{4, 8}, {5, 1}}}) {
    problem.wall = wall;
    const StationaryState end = transient(problem, {1e3, 1e9, 1e-4, 4}, {});
    ASSERT_EQ(end.outcome.status, Status::converged) << end.outcome.message;
    EXPECT_NEAR(end.shape.deformation / stationary, 1, 1e-3);
  }
}

TEST(ChannelEntry, AFailedRunKeepsItsLastGoodStateAndItsHistory) {
  // A soft cell is drawn out in the contraction until no step succeeds: a named status, a sentence, and finite numbers
  // of the last state with the walls where they were.
  Problem problem = entering_cell();
  problem.bulk.shear_modulus /= 30;
  int steps = 0;
  double position = 0;
  const auto count = [&](const TimePoint& point, const TimeState&) { ++steps, position = point.position; };
  const StationaryState end = transient(problem, {60, 1e9, 1e-3, 3}, {{}, count});
  EXPECT_NE(end.outcome.status, Status::converged);
  EXPECT_NE(end.outcome.message.find("the last good state is kept"), std::string::npos) << end.outcome.message;
  EXPECT_GT(steps, 5);
  EXPECT_GT(position, 1);
  EXPECT_TRUE(std::isfinite(end.shape.deformation));
  EXPECT_NEAR(end.relative_volume_change, 0, 1e-6);
}

}  // namespace
}  // namespace rheocyte::channel_entry_test
