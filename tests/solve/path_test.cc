#include "solve/path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cases.h"
#include "fem/observe.h"
#include "shape/measures.h"
#include "solve/arclength.h"
#include "solve/continuation.h"

namespace rheocyte {
namespace {

const Resolution resolution = {{2, 4, 1, 2}, 5};

/// A solid with a cortex of every kind.
Problem combined() {
  Problem problem = test::problem({6, 2.29, 0.5});
  problem.cortex = CortexLaw::neo_hookean;
  problem.cortex_modulus = 2;
  problem.tension = 0.2;
  problem.bending_stiffness = 0.01;
  problem.reynolds = 0.05;
  return problem;
}

Problem shell() {
  Problem problem = combined();
  problem.bulk = BulkLaw::none;
  problem.shear_modulus = 0;
  problem.cortex_modulus = 20;
  return problem;
}

/// Follows the branch in the compliance.
VectorXd solve(const Problem& problem, Discrete& discrete) {
  const ContinuationReport first = start_branch(discrete.system, problem, {});
  const auto report = continue_branch(stiffness_path(discrete.system, problem), {}, first.last);
  EXPECT_EQ(report.status, Status::converged);
  return report.last.unknowns;
}

TEST(Path, BetweenTwoProblemsLieTheirMeans) {
  // Geometric where both are positive, arithmetic where one is zero, and both ends exactly.
  Problem a = combined(), b = combined();
  b.shear_modulus = 4 * a.shear_modulus;
  b.tension = 0;
  b.radius_ratio = 0.6;
  EXPECT_DOUBLE_EQ(between(a, b, 0.5).shear_modulus, 2 * a.shear_modulus);
  EXPECT_DOUBLE_EQ(between(a, b, 0.25).tension, 0.75 * a.tension);
  EXPECT_EQ(between(a, b, 0).radius_ratio, a.radius_ratio);
  EXPECT_EQ(between(a, b, 1).radius_ratio, b.radius_ratio);
}

struct Change {
  std::string name;
  double Problem::*number;
  double factor;
};

class AnyParameter : public testing::TestWithParam<Change> {};

TEST_P(AnyParameter, LeadsToTheStateThatTheStiffnessLeadsTo) {
  // From one problem to another in any number, for a solid with a cortex and for a shell.
  for (const Problem& from : {combined(), shell()}) {
    Problem to = from;
    to.*GetParam().number *= GetParam().factor;
    const Resolution common = path_resolution(from, to, resolution);
    Discrete start(from, common), end(to, common);
    const VectorXd wanted = solve(to, end);
    const auto report = continue_branch(problem_path(from, to, resolution), {}, {0, solve(from, start), {}, 0});
    ASSERT_EQ(report.status, Status::converged) << name(report.status) << " at " << report.last.parameter;
    // Newton's tolerance of 1e-11 times the condition of the state.
    EXPECT_LT((report.last.unknowns - wanted).norm() / wanted.norm(), 1e-8);
  }
}

const Change changes[] = {{"bulk", &Problem::shear_modulus, 1.5},  {"cortex", &Problem::cortex_modulus, 1.7},
                          {"tension", &Problem::tension, 2},       {"bending", &Problem::bending_stiffness, 20},
                          {"radius", &Problem::radius_ratio, 1.1}, {"smaller", &Problem::radius_ratio, 0.8},
                          {"inertia", &Problem::reynolds, 10}};
INSTANTIATE_TEST_SUITE_P(Number, AnyParameter, testing::ValuesIn(changes),
                         [](const auto& test) { return test.param.name; });

TEST(Path, TheTangentInTheRadiusIsExact) {
  // The geometry moves with the parameter; the prediction still is of second order.
  const Problem from = combined();
  Problem to = from;
  to.radius_ratio *= 1.2;
  Discrete discrete(from, path_resolution(from, to, resolution));
  const Path path = problem_path(from, to, resolution);
  BranchState state{0, solve(from, discrete), {}, 0};
  double det = 0;
  bool factorised = false;
  path.system(0).linearise(path.media(0), state.unknowns, det, factorised);
  state.tangent = branch_tangent(path, state);
  const auto error = [&](double h) {
    VectorXd x = state.unknowns + h * state.tangent;
    const VectorXd guess = x;
    EXPECT_EQ(newton(path.system(h), path.media(h), {}, x).status, Status::converged);
    return (x - guess).norm();
  };
  EXPECT_NEAR(std::log2(error(0.1) / error(0.05)), 2, 0.15);
}

/// A soft solid whose surface a bending stiffness of 1e4 k_B T holds: its branch has a fold at a compliance of 0.892.
struct Folded {
  Folded() : problem(test::problem({6, 1.5, 1})), discrete(problem_with_bending(), {{3, 6, 1, 2}, 6}) {}
  const Problem& problem_with_bending() {
    problem.bending_stiffness = 1e4 * 4.116e-21 / (145.864 * std::pow(10.94e-6, 3));
    return problem;
  }
  ArcReport trace(int steps) {
    const ContinuationReport first = start_branch(discrete.system, problem, {});
    Path path = stiffness_path(discrete.system, problem);
    Path to_start = path;
    to_start.end = 0.8;
    const auto start = continue_branch(to_start, {}, first.last);
    EXPECT_EQ(start.status, Status::converged);
    ArcOptions options;
    options.step_limit = steps;
    return trace_arc(path, options, start.last);
  }
  Problem problem;
  Discrete discrete;
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
    const double d = measure(contour(folded.discrete.space, state.unknowns)).deformation;
    EXPECT_GT(d, before);
    before = d;
    double det = 0;
    const Media media = media_at(folded.problem, state.parameter);
    const double residual = folded.discrete.system.residual(media, state.unknowns, det).norm();
    EXPECT_LT(residual / residual_scale(folded.discrete.system, media), 1e-10);
  }
}

TEST(Arclength, AwayFromFoldsItFindsTheStatesOfTheParameter) {
  // The same branch as steps in the compliance.
  Folded folded;
  const ArcReport report = folded.trace(3);
  ASSERT_EQ(report.status, Status::converged);
  const BranchState& last = report.states.back();
  VectorXd x = report.states[2].unknowns;
  ASSERT_EQ(newton(folded.discrete.system, media_at(folded.problem, last.parameter), {}, x).status, Status::converged);
  EXPECT_LT((x - last.unknowns).norm() / x.norm(), 1e-8);
}

TEST(Arclength, ItEndsWhereItIsTold) {
  // The observer's refusal ends the trace with success; the state that it saw is kept.
  Folded folded;
  const ContinuationReport first = start_branch(folded.discrete.system, folded.problem, {});
  ArcOptions options;
  int seen = 0;
  options.go_on = [&](const Discretisation&, const BranchState&) { return ++seen < 2; };
  const ArcReport report = trace_arc(stiffness_path(folded.discrete.system, folded.problem), options, first.last);
  EXPECT_EQ(report.status, Status::converged);
  EXPECT_EQ(report.states.size(), 3u);
}

}  // namespace
}  // namespace rheocyte
