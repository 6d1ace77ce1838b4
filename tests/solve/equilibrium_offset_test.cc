// The place where a cell does not drift, of a drift that is known.
#include "solve/equilibrium_offset.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "case/scales.h"

namespace rheocyte::equilibrium_offset_test {
namespace {

Problem problem_at(double offset) {
  Problem problem;
  problem.section = Section::square;
  problem.radius_ratio = 0.4;
  problem.offset = offset;
  problem.place = CellPlace::equilibrium;
  problem.accuracy = 1e-3;
  return problem;
}

/// Outwards within `place`, inwards beyond; the coarse solutions are a little off. Works as long as it may.
struct Drift {
  double place;
  int calls_left = 100;
  int calls = 0;

  StationaryState operator()(const Problem& problem) {
    StationaryState state;
    ++calls;
    state.statistics.newton_iterations = 2;
    state.outcome.reached = calls > calls_left ? 0.5 : 1;
    state.outcome.status = calls > calls_left ? Status::surface_unstable : Status::converged;
    const double o = problem.offset, there = place + problem.accuracy;
    state.offset = o;
    state.drift_velocity = 0.1 * o * (there * there - o * o);
    return state;
  }
};

TEST(EquilibriumOffset, IsFoundFromBothSides) {
  for (const double start : {0.1, 0.3, 0.5, -0.5}) {
    Drift drift{0.35};
    const StationaryState state = solve_at_equilibrium(problem_at(start), std::ref(drift));
    EXPECT_EQ(state.outcome.status, Status::converged);
    EXPECT_NEAR(std::abs(state.offset), 0.351, 1e-3) << start;
    EXPECT_EQ(state.offset > 0, start > 0);
    EXPECT_NEAR(state.offset_error, 0.009 + 1e-3, 2e-3) << "what the tenth of the accuracy changes";
    EXPECT_LT(drift.calls, 14);
    EXPECT_EQ(state.statistics.newton_iterations, 2 * drift.calls) << "the work of all";
  }
}

TEST(EquilibriumOffset, NumbersAreAsUncertainAsThePlaceMakesThem) {
  // A velocity that falls linearly off the axis: its slope times the place's error, and its own error; to rounding.
  Drift drift{0.35};
  const auto solve = [&](const Problem& problem) {
    StationaryState state = drift(problem);
    state.cell_velocity = 2 - 0.5 * problem.offset;
    state.errors.cell_velocity = 1e-5;
    return state;
  };
  const StationaryState state = solve_at_equilibrium(problem_at(0.1), solve);
  EXPECT_NEAR(state.errors.cell_velocity, 0.5 * state.offset_error + 1e-5, 1e-12);
  EXPECT_EQ(state.errors.offset, state.offset_error);
}

TEST(EquilibriumOffset, ACellThatDriftsToTheAxisIsSolvedThere) {
  const auto drift = [](const Problem& problem) {
    StationaryState state;
    state.outcome.status = Status::converged;
    state.drift_velocity = -0.1 * problem.offset;
    state.shape.deformation = problem.offset == 0 ? 0.02 : 0.01;
    return state;
  };
  const StationaryState state = solve_at_equilibrium(problem_at(0.3), drift);
  EXPECT_EQ(state.outcome.status, Status::converged);
  EXPECT_EQ(state.offset, 0);
  EXPECT_EQ(state.shape.deformation, 0.02);
  EXPECT_NE(state.outcome.message.find("drifts to the axis"), std::string::npos);
}

TEST(EquilibriumOffset, ACellThatDriftsToTheWallHasNone) {
  Drift drift{0.9};
  const StationaryState state = solve_at_equilibrium(problem_at(0.3), std::ref(drift));
  EXPECT_EQ(state.outcome.status, Status::no_equilibrium);
  EXPECT_NEAR(state.offset, 0.55, 1e-12) << "0.95 of half the width less the radius";
  EXPECT_NE(state.outcome.message.find("towards the wall"), std::string::npos) << state.outcome.message;
}

TEST(EquilibriumOffset, AStateThatIsNotFoundEndsTheSearch) {
  for (const int calls : {0, 1, 3, 5, 7}) {
    Drift drift{0.35, calls};
    const StationaryState state = solve_at_equilibrium(problem_at(0.1), std::ref(drift));
    EXPECT_EQ(state.outcome.status, Status::surface_unstable) << calls;
    EXPECT_EQ(drift.calls, calls + 1);
    EXPECT_TRUE(std::isnan(state.offset_error));
  }
}

TEST(EquilibriumOffset, AnUnstableSurfaceOnTheWayDoesNotEndTheSearch) {
  // Its drift is known all the same; what counts is the state at the place, here a stable one or not.
  for (const double unstable_beyond : {0.4, 0.3}) {
    Drift drift{0.35};
    const auto solve = [&](const Problem& problem) {
      StationaryState state = drift(problem);
      if (problem.offset > unstable_beyond) state.outcome.status = Status::surface_unstable;
      return state;
    };
    const StationaryState state = solve_at_equilibrium(problem_at(0.5), solve);
    EXPECT_EQ(state.outcome.status, unstable_beyond > 0.351 ? Status::converged : Status::surface_unstable);
    EXPECT_NEAR(state.offset, 0.351, 1e-3);
  }
}

TEST(EquilibriumOffset, WhereCorrectionsDoNotSettleTheErrorSaysSo) {
  // Secants of a cube root lead away from its zero.
  const double place = 0.35;
  const auto drift = [&](const Problem& problem) {
    StationaryState state;
    state.outcome.status = Status::converged;
    state.offset = problem.offset;
    const double short_of = place - problem.offset;
    state.drift_velocity = problem.accuracy > 5e-3 ? short_of + 0.01 : std::cbrt(short_of);
    return state;
  };
  const StationaryState state = solve_at_equilibrium(problem_at(0.3), drift);
  EXPECT_EQ(state.outcome.status, Status::accuracy_not_reached);
  EXPECT_NE(state.outcome.message.find("has not settled"), std::string::npos) << state.outcome.message;
  EXPECT_GT(std::abs(state.offset - place), 2e-3) << "else there is nothing to say";
  EXPECT_GT(state.offset_error, std::abs(state.offset - place));
}

TEST(EquilibriumOffset, CellsThatNearlyFillTheDuctHaveLittleWayToTheAxis) {
  Problem problem = problem_at(0.008);
  problem.radius_ratio = 0.94;
  std::vector<double> offsets;
  const auto drift = [&](const Problem& at) {
    offsets.push_back(at.offset);
    StationaryState state;
    state.outcome.status = Status::converged;
    state.drift_velocity = -0.1 * at.offset;
    return state;
  };
  EXPECT_EQ(solve_at_equilibrium(problem, drift).offset, 0);
  EXPECT_EQ(offsets, (std::vector<double>{0.008, 0.5 * max_offset(1, 0.94), 0}));
}

}  // namespace
}  // namespace rheocyte::equilibrium_offset_test
