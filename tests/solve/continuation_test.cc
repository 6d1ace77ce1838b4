#include "solve/continuation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cases.h"
#include "fem/observe.h"
#include "solve/tube.h"

namespace rheocyte::continuation_test {
namespace {

const Resolution resolution = {{2, 4, 1, 2}, 5};

struct CoarseProblem {
  explicit CoarseProblem(const Problem& p) : problem(p), discrete(p, resolution) {}
  ContinuationReport start(const ContinuationOptions& options) {
    return start_branch(stiffness_path(discrete.system(), problem), options);
  }
  ContinuationReport follow(const ContinuationOptions& options) {
    const ContinuationReport first = start(options);
    if (first.status != Status::converged) return first;
    return continue_branch(stiffness_path(discrete.system(), problem), options, first.last);
  }
  Problem problem;
  TubeDiscrete discrete;
};

TEST(Continuation, TheComplianceDividesTheModulus) {
  // c = 1 is the wanted stiffness, c -> 0 the rigid cell.
  const Problem problem = test::problem({6, 2.29, 0});
  EXPECT_DOUBLE_EQ(media_at(problem, 1).bulk.shear_modulus, problem.bulk.shear_modulus);
  EXPECT_DOUBLE_EQ(media_at(problem, 0.1).bulk.shear_modulus, 10 * problem.bulk.shear_modulus);
}

/// || x(c + h) - x(c) - h x'(c) ||
double prediction_error(CoarseProblem& coarse, const BranchState& state, double h) {
  VectorXd x = state.unknowns + h * state.tangent;
  const VectorXd guess = x;
  const Media media = media_at(coarse.problem, state.parameter + h);
  EXPECT_EQ(newton(coarse.discrete.system(), media, {}, x).status, Status::converged);
  return (x - guess).norm();
}

TEST(Continuation, TheTangentPredictsToSecondOrder) {
  // With a fresh factorisation the error of the prediction falls like h^2, in liquids of both kinds.
  for (const Problem& problem : {test::problem({6, 2.29, 1}), test::in_power_law_liquid(test::problem({7.66, 5, 0}))}) {
    CoarseProblem coarse(problem);
    ContinuationOptions options;
    options.newton.chord_steps = false;
    const BranchState state = coarse.start(options).last;
    ASSERT_GT(state.tangent.size(), 0);
    for (const double h : {0.04 * state.parameter, 0.02 * state.parameter}) {
      const double ratio = prediction_error(coarse, state, h) / prediction_error(coarse, state, h / 2);
      EXPECT_NEAR(std::log2(ratio), 2.0, 0.1);  // the cubic term adds some per cent at this step
    }
  }
}

TEST(Continuation, TheTangentOfAKeptFactorisationIsGoodEnoughToPredict) {
  // After chord steps the tangent is that of an earlier iterate: not exact, but off by less than a fifth.
  for (const test::CellInChannel& cell : {test::CellInChannel{6, 2.29, 0}, {6, 2.29, 1}, {7.66, 3.437, 1}}) {
    CoarseProblem coarse(test::problem(cell));
    ContinuationOptions cheap, fresh;
    fresh.newton.chord_steps = false;
    const BranchState one = coarse.start(cheap).last, other = coarse.start(fresh).last;
    ASSERT_EQ(one.parameter, other.parameter);
    EXPECT_LT((one.tangent - other.tangent).norm() / other.tangent.norm(), 0.2);
  }
}

TEST(Continuation, TheStateDoesNotDependOnThePath) {
  // Small and large steps reach the same state.
  for (const Problem& problem : {test::problem({6, 2.29, 0}), test::problem({7.66, 3.437, 1}),
                                 test::in_power_law_liquid(test::problem({6, 2, 1}))}) {
    CoarseProblem coarse(problem);
    ContinuationOptions large, small;
    large.displacement_per_step = 0.2;
    small.displacement_per_step = 0.03;
    const ContinuationReport one = coarse.follow(large), other = coarse.follow(small);
    ASSERT_EQ(one.status, Status::converged);
    ASSERT_EQ(other.status, Status::converged);
    EXPECT_GT(other.steps, one.steps);
    EXPECT_EQ(one.last.parameter, 1);
    // Newton's tolerance of 1e-11 times the condition of the state.
    EXPECT_LT((one.last.unknowns - other.last.unknowns).norm() / one.last.unknowns.norm(), 1e-8);
  }
}

TEST(Continuation, AStiffCellNeedsOneStep) {
  // The first state is the wanted one when the displacement is below the aim of a step.
  CoarseProblem coarse(test::problem({6, 50, 1}));
  const ContinuationReport report = coarse.start({});
  EXPECT_EQ(report.status, Status::converged);
  EXPECT_EQ(report.last.parameter, 1);
  EXPECT_EQ(coarse.follow({}).steps, 0) << "nothing is left to continue";
}

TEST(Continuation, AStateThatIsNotAcceptedEndsTheBranchBeforeIt) {
  // The last accepted state stays, and the reason is the surface.
  CoarseProblem coarse(test::problem({6, 2.29, 0}));
  ContinuationOptions options;
  options.displacement_per_step = 0.03;
  options.accept = [](const NonlinearSystem&, const BranchState& state) { return state.parameter < 0.5; };
  const ContinuationReport report = coarse.follow(options);
  EXPECT_EQ(report.status, Status::surface_unstable);
  EXPECT_GT(report.last.parameter, 0);
  EXPECT_LT(report.last.parameter, 0.5);
  EXPECT_TRUE(report.last.unknowns.allFinite());
}

TEST(Continuation, AFailedStepKeepsTheLastGoodState) {
  // Far beyond the end of the branch the steps are halved to the least one; the last state still solves its equations.
  CoarseProblem coarse(test::problem({6, 0.3, 0}));
  ContinuationOptions options;
  options.newton.iteration_limit = 5;
  options.min_step = 0.03;
  const ContinuationReport report = coarse.follow(options);
  EXPECT_NE(report.status, Status::converged);
  EXPECT_LT(report.last.parameter, 1);
  const Media media = media_at(coarse.problem, report.last.parameter);
  const auto [residual, min_det] = coarse.discrete.system().residual(media, report.last.unknowns);
  EXPECT_LT(residual.norm() / residual_scale(coarse.discrete.system(), media), options.newton.tolerance);
  EXPECT_GT(min_det, 0);
}

TEST(Continuation, AStopIsReported) {
  // The flag ends the start of the branch as well as its continuation.
  CoarseProblem coarse(test::problem({6, 2.29, 0}));
  const BranchState first = coarse.start({}).last;
  const std::atomic<bool> stop = true;
  ContinuationOptions options;
  options.newton.stop = &stop;
  EXPECT_EQ(coarse.start(options).status, Status::stopped);
  const ContinuationReport report =
      continue_branch(stiffness_path(coarse.discrete.system(), coarse.problem), options, first);
  EXPECT_EQ(report.status, Status::stopped);
  EXPECT_EQ(report.last.parameter, first.parameter);
}

}  // namespace
}  // namespace rheocyte::continuation_test
