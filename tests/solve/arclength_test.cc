#include "solve/arclength.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cases.h"
#include "fem/observe.h"
#include "shape/measures.h"
#include "solve/stationary.h"
#include "solve/tube.h"

namespace rheocyte::arclength_test {
namespace {

/// A soft solid whose surface a bending stiffness of 1e4 k_B T holds: its branch has a fold at a compliance of 0.892.
struct Folded {
  Folded() : problem(test::problem({6, 1.5, 1})), discrete(problem_with_bending(), {{3, 6, 1, 2}, 6}) {}
  const Problem& problem_with_bending() {
    problem.cortex.bending = 1e4 * 4.116e-21 / (145.864 * std::pow(10.94e-6, 3));
    return problem;
  }
  ArcReport trace(int steps) {
    const ContinuationReport first = start_branch(stiffness_path(discrete.system(), problem), {});
    Path path = stiffness_path(discrete.system(), problem);
    Path to_start = path;
    to_start.end = 0.8;
    const auto start = continue_branch(to_start, {}, first.last);
    EXPECT_EQ(start.status, Status::converged);
    ArcOptions options;
    options.step_limit = steps;
    return trace_arc(path, options, start.last);
  }
  Problem problem;
  TubeDiscrete discrete;
};

TEST(Arclength, ItGoesRoundTheFoldOfABranch) {
  // The compliance rises, turns and falls while the cell goes on to be drawn out; every state solves its equations.
  Folded folded;
  const ArcReport report = folded.trace(14);
  ASSERT_EQ(report.folds.size(), 1u) << name(report.status);
  const BranchState& fold = report.states[report.folds[0]];
  EXPECT_GT(report.states.size(), std::size_t(report.folds[0] + 2));
  EXPECT_LT(report.states.back().parameter, fold.parameter);
  double before = 0;
  for (const BranchState& state : report.states) {
    const double d = measure(contour(folded.discrete.space(), state.unknowns)).deformation;
    EXPECT_GT(d, before);
    before = d;
    const Media media = media_at(folded.problem, state.parameter);
    const double residual = folded.discrete.system().residual(media, state.unknowns).value.norm();
    EXPECT_LT(residual / residual_scale(folded.discrete.system(), media), 1e-10);
  }
}

TEST(Arclength, TheParameterOfAFoldIsThatOfAParabola) {
  // c = 0.9 - 2 (a - 0.3)^2 of the arc a, from states at 0.1 and 0.35; and on the branch, where each state of a trace
  // lies before it.
  ArcReport parabola;
  for (const double arc : {0.1, 0.35}) {
    parabola.arcs.push_back(arc);
    parabola.slopes.push_back(-4 * (arc - 0.3));
    parabola.states.push_back({0.9 - 2 * std::pow(arc - 0.3, 2), {}, {}, 0});
  }
  EXPECT_NEAR(turning_parameter(parabola, 0), 0.9, 1e-14);
  Folded folded;
  const ArcReport report = folded.trace(14);
  ASSERT_EQ(report.folds.size(), 1u);
  const double turning = turning_parameter(report, report.folds[0]);
  for (const BranchState& state : report.states) EXPECT_LT(state.parameter, turning);
  EXPECT_NEAR(turning, 0.892, 1e-3);
}

TEST(Arclength, AwayFromFoldsItFindsTheStatesOfTheParameter) {
  // The same branch as steps in the compliance.
  Folded folded;
  const ArcReport report = folded.trace(3);
  ASSERT_EQ(report.status, Status::converged);
  const BranchState& last = report.states.back();
  VectorXd x = report.states[2].unknowns;
  ASSERT_EQ(newton(folded.discrete.system(), media_at(folded.problem, last.parameter), {}, x).status,
            Status::converged);
  EXPECT_LT((x - last.unknowns).norm() / x.norm(), 1e-8);
}

TEST(Arclength, ACellBeyondTheFoldIsToldThatItsBranchTurns) {
  // Of the moduli at which it does: those of the fold, with the last state just before it.
  Folded folded;
  Problem softer = folded.problem;
  softer.bulk.shear_modulus *= 1.64 / 1.5;
  const StationaryState state = solve_stationary(softer);
  EXPECT_EQ(state.outcome.status, Status::limit_point) << state.outcome.message;
  EXPECT_NEAR(state.outcome.reached, 0.892 * 1.64 / 1.5, 0.01);
  EXPECT_NE(state.outcome.message.find("turns back at 1.02"), std::string::npos) << state.outcome.message;
  EXPECT_NEAR(state.shape.deformation, 0.112, 0.004);
}

TEST(Arclength, ItEndsWhereItIsTold) {
  // The observer's refusal ends the trace with success; the state that it saw is kept.
  Folded folded;
  const ContinuationReport first = start_branch(stiffness_path(folded.discrete.system(), folded.problem), {});
  ArcOptions options;
  int seen = 0;
  options.go_on = [&](const BranchState&) { return ++seen < 2; };
  const ArcReport report = trace_arc(stiffness_path(folded.discrete.system(), folded.problem), options, first.last);
  EXPECT_EQ(report.status, Status::converged);
  EXPECT_EQ(report.states.size(), 3u);
}

}  // namespace
}  // namespace rheocyte::arclength_test
