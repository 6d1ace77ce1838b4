#include "solve/settle.h"

#include <gtest/gtest.h>

#include "cases.h"
#include "solve/tube.h"

namespace rheocyte::settle_test {
namespace {

TEST(Settle, AStateIsReachedThatNewtonMisses) {
  // From a much stiffer cell: three iterations are too few.
  const Problem problem = test::problem({6, 2.29, 0});
  TubeDiscrete discrete(problem, {{2, 4, 1, 2}, 5});
  const Path path = stiffness_path(discrete.system(), problem);
  ContinuationOptions way;
  way.newton.tolerance = 1e-10;
  const ContinuationReport start = start_branch(path, way);
  ASSERT_EQ(start.status, Status::converged);
  const ContinuationReport whole = continue_branch(path, way, start.last);
  ASSERT_EQ(whole.status, Status::converged);

  const NewtonOptions few{.tolerance = 1e-10, .iteration_limit = 3, .chord_steps = false};
  VectorXd guess = start.last.unknowns;
  discrete.system().scale_displacement(0.5, guess);
  VectorXd missed = guess;
  EXPECT_NE(newton(discrete.system(), problem, few, missed).status, Status::converged);
  const ContinuationReport settled = settle(discrete.system(), problem, guess, few);
  ASSERT_EQ(settled.status, Status::converged);
  EXPECT_EQ(settled.last.parameter, 1);
  EXPECT_GT(settled.steps, 1);
  EXPECT_LT((settled.last.unknowns - whole.last.unknowns).norm(), 1e-6 * whole.last.unknowns.norm());
}

TEST(Settle, StopsWhenAsked) {
  const Problem problem = test::problem({6, 2.29, 0});
  TubeDiscrete discrete(problem, {{2, 4, 1, 2}, 4});
  const std::atomic<bool> stop = true;
  NewtonOptions options;
  options.stop = &stop;
  EXPECT_EQ(settle(discrete.system(), problem, discrete.system().sphere(), options).status, Status::stopped);
}

}  // namespace
}  // namespace rheocyte::settle_test
