// Every number of a cell on its way has an error, which contains those of the steps and of the mesh.
#include "solve/time_errors.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <string>

#include "cases.h"

namespace rheocyte::time_errors_test {
namespace {

constexpr double unit_us = 102.835;  // R/U of cases.h

/// A cell of 7 um with some tension, as viscous as the liquid; in a contraction from 2 R to R or in a straight tube.
Problem moving_cell(bool is_entering) {
  Problem problem = test::problem({7, 4.58, 1}, 1e-4);
  problem.liquid.reynolds = problem.bulk.reynolds = 0.0776;
  problem.bulk.viscosity = 1;
  problem.cortex.tension = 0.1;
  if (is_entering) problem.wall = {{0.5, 2}, {1.5, 1}};
  return problem;
}

struct Followed {
  StationaryState end;
  TimeWay way, errors;
};

Followed followed(const Problem& problem, const TimeRun& run) {
  Followed result;
  const TimeObserver observer{
      [&](const TimeFrame& frame) {
        result.way.outputs.push_back({.time = frame.time, .position = frame.position, .state = frame.state});
      },
      [&](const TimePoint& point, const TimeState&) { result.way.steps.push_back(point); },
      [&](const TimeWay& errors) { result.errors = errors; }};
  result.end = transient(problem, run, observer);
  return result;
}

/// How many numbers are farther from those of a far more accurate run than `factor` times what is stated.
int count_beyond(double factor, const TimePoint& point, const TimePoint& stated, const TimePoint& exact) {
  constexpr double rounding = 1e-8;  // and Newton's tolerance, 1e-9 of the forces
  const auto is_beyond = [&](double value, double error, double other) {
    return std::isfinite(value) && !(std::abs(value - other) <= factor * error + rounding * (1 + std::abs(value)));
  };
  int beyond =
      is_beyond(point.time, stated.time, exact.time) + is_beyond(point.position, stated.position, exact.position);
  for (const StateMeasure& measure : state_measures)
    beyond += is_beyond(measure.value(point.state), measure.value(stated.state), measure.value(exact.state));
  return beyond;
}

class TimeErrors : public testing::TestWithParam<double> {};

TEST_P(TimeErrors, ContainThoseOfStepsAndMesh) {
  // Crude and better steps, against steps whose error is far less on a mesh two degrees finer: of all
  // numbers of all outputs one in twenty is farther off than it says at most, none twice as far; a run at a time and
  // one that ends, and has its outputs, at places.
  for (const bool is_entering : {false, true}) {
    SCOPED_TRACE(is_entering);
    TimeRun run{20 / unit_us, 4 / unit_us, GetParam(), 4};
    if (is_entering) {
      run.end = HUGE_VAL;
      run.end_position = 1;
      run.output_every = 0.2;
      run.outputs_by_place = true;
    }
    run.estimates_error = true;
    const Followed here = followed(moving_cell(is_entering), run);
    ASSERT_EQ(here.end.outcome.status, Status::converged) << here.end.outcome.message;
    run.accuracy = GetParam() / 50;
    run.step_factor = 0.5;
    run.degree = 6;
    run.estimates_error = false;
    const Followed exact = followed(moving_cell(is_entering), run);
    ASSERT_EQ(here.way.outputs.size(), exact.way.outputs.size());
    ASSERT_EQ(here.way.outputs.size(), here.errors.outputs.size());
    int numbers = 0, beyond = 0, twice = 0;
    for (std::size_t i = 1; i < here.way.outputs.size(); ++i) {
      const TimePoint &point = here.way.outputs[i], &stated = here.errors.outputs[i], &other = exact.way.outputs[i];
      numbers += 2 + int(std::size(state_measures));
      beyond += count_beyond(1, point, stated, other);
      twice += count_beyond(2, point, stated, other);
    }
    EXPECT_LE(beyond, numbers / 20) << numbers;
    EXPECT_EQ(twice, 0) << numbers;
    // The last output is the last state, found by its place: to rounding, 1e-9.
    EXPECT_NEAR(here.errors.outputs.back().state.cell_velocity, here.end.errors.cell_velocity, 1e-9);
    EXPECT_NEAR(here.errors.steps.back().state.shape.area, here.end.errors.shape.area, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Accuracies, TimeErrors, testing::Values(3e-3, 1e-3, 1e-4));

/// Into the contraction, with outputs several times as dense as the steps.
TimeRun run_with_many_outputs() {
  TimeRun run{HUGE_VAL, 0.01, 1e-3, 4};
  run.end_position = 1;
  run.estimates_error = true;
  return run;
}

TEST(TimeErrorsOfARun, ContainWhatTheVolumeOfAnIncompressibleCellIsOff) {
  // Exactly, between steps, too, where the shape is interpolated; of the volume to its rounding.
  const Followed here = followed(moving_cell(true), run_with_many_outputs());
  ASSERT_FALSE(here.errors.outputs.empty());
  const double volume = here.way.outputs.front().state.shape.volume;
  double greatest = 0;
  for (std::size_t i = 0; i < here.errors.outputs.size(); ++i) {
    const StateNumbers &numbers = here.way.outputs[i].state, &errors = here.errors.outputs[i].state;
    EXPECT_GE(errors.relative_volume_change, std::abs(numbers.relative_volume_change)) << i;
    EXPECT_GE(errors.shape.volume, std::abs(numbers.shape.volume - volume) - 1e-12 * volume) << i;
    greatest = std::max(greatest, std::abs(numbers.relative_volume_change));
  }
  EXPECT_GT(greatest, 1e-8) << "interpolated";
}

/// A small cell, soft and far more viscous than its liquid, whose inertia lets velocities change like the root of time
/// at first: steps grow as fast as they may, however accurate they are to be, and say little of each other.
Problem slow_starter() {
  Problem problem = test::problem({3.42, 1, 1}, 1e-4);
  problem.liquid.reynolds = problem.bulk.reynolds = 1;
  problem.bulk.shear_modulus = 0.3;
  problem.bulk.viscosity = 15;
  return problem;
}

TEST(TimeErrorsOfARun, ContainThoseOfAStartInStepsThatOnlyGrow) {
  // Of all numbers at outputs far denser than the steps one in twenty is farther from those of steps a hundred times as
  // accurate than it says at most, none twice as far.
  constexpr int outputs = 100;
  for (const double end : {0.07, 0.5}) {
    SCOPED_TRACE(end);
    TimeRun run{end, end / outputs, 1e-5, 4};
    run.estimates_error = true;
    const Followed here = followed(slow_starter(), run);
    run.accuracy /= 100;
    run.estimates_error = false;
    const Followed exact = followed(slow_starter(), run);
    ASSERT_EQ(here.errors.outputs.size(), outputs + 1);
    ASSERT_EQ(exact.way.outputs.size(), outputs + 1);
    int beyond = 0, twice = 0;
    for (std::size_t i = 1; i <= outputs; ++i) {
      beyond += count_beyond(1, here.way.outputs[i], here.errors.outputs[i], exact.way.outputs[i]);
      twice += count_beyond(2, here.way.outputs[i], here.errors.outputs[i], exact.way.outputs[i]);
    }
    EXPECT_LE(beyond, outputs * (2 + int(std::size(state_measures))) / 20);
    EXPECT_EQ(twice, 0);
  }
}

TEST(TimeErrorsOfARun, AreThoseOfEveryStepAndOutputAlsoWhereTheCellSettles) {
  // The time is that of a run by time; errors of the place accumulate.
  TimeRun run{5000 / unit_us, 100 / unit_us, 1e-4, 3};
  run.estimates_error = true;
  const Followed here = followed(moving_cell(false), run);
  ASSERT_EQ(here.end.outcome.status, Status::converged);
  ASSERT_LT(here.way.steps.back().time, run.end) << "it settles";
  ASSERT_EQ(here.errors.steps.size(), here.way.steps.size());
  ASSERT_EQ(here.errors.outputs.size(), here.way.outputs.size());
  double position = 0;
  for (const TimePoint& errors : here.errors.steps) {
    EXPECT_LT(errors.time, 1e-9);
    EXPECT_GE(errors.position, position);
    EXPECT_GE(errors.state.shape.deformation, 0);
    position = errors.position;
  }
  EXPECT_GT(position, 0);
  EXPECT_LT(position, 1e-2 * here.way.steps.back().position);
}

TEST(TimeErrorsOfARun, AreRelativeToADeformationThatCellsHave) {
  // Steps of 1e-2 on a mesh for 1e-3: not relative to a deformation of 10.
  TimeRun run{30 / unit_us, 1e9, 1e-2};
  run.mesh_accuracy = 1e-3;
  run.estimates_error = true;
  const StationaryState state = transient(moving_cell(false), run, {});
  ASSERT_EQ(state.outcome.status, Status::converged);
  EXPECT_LE(state.deformation_floor, 0.01);
  EXPECT_DOUBLE_EQ(state.estimated_error,
                   state.errors.shape.deformation / std::max(state.shape.deformation, state.deformation_floor));
  EXPECT_GT(state.step_error, 0);
  EXPECT_LE(state.step_error, state.estimated_error);
}

TEST(TimeErrorsOfARun, ThatIsStoppedMeanwhileAreNotKnownAndItIsNotConverged) {
  // Stopped as soon as the run itself has arrived; the state is there, and a continued run computes its errors.
  std::atomic<bool> stop = false;
  TimeRun run{0.4, 0.4, 1e-4, 3};
  run.estimates_error = true;
  bool has_errors = false;
  const TimeObserver stopper{
      [&](const TimeFrame& frame) { stop = frame.time > 0; }, {}, [&](const TimeWay&) { has_errors = true; }};
  const StationaryState state = transient(moving_cell(true), run, stopper, nullptr, &stop);
  EXPECT_EQ(state.outcome.status, Status::error_unknown);
  EXPECT_EQ(state.comparison, Status::stopped);
  EXPECT_TRUE(std::isnan(state.estimated_error));
  EXPECT_TRUE(std::isnan(state.errors.cell_velocity));
  EXPECT_GT(state.shape.deformation, 0);
  EXPECT_FALSE(has_errors);
  EXPECT_NE(state.outcome.message.find("A signal stopped the computation of its error; --continue computes it."),
            std::string::npos)
      << state.outcome.message;
}

}  // namespace
}  // namespace rheocyte::time_errors_test
