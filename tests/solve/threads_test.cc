// Threads within one solution (docs/theory-square.md, eq:nested).
#include <gtest/gtest.h>

#include "solve/stationary.h"
#include "solve/tube.h"

namespace rheocyte::threads_test {
namespace {

void expect_same(const StationaryState& a, const StationaryState& b) {
  EXPECT_EQ(a.outcome.status, b.outcome.status);
  EXPECT_EQ(a.shape.deformation, b.shape.deformation);
  EXPECT_EQ(a.residual, b.residual);
  EXPECT_EQ(a.estimated_error, b.estimated_error);
  EXPECT_EQ(a.pressure_drop, b.pressure_drop);
  EXPECT_EQ(a.surface.point, b.surface.point);
  EXPECT_EQ(a.surface.tension, b.surface.tension);
}

/// A cell with a shell under tension, so that patches of the surface add to what their elements do.
Problem cell_in(Section section, double accuracy) {
  Problem problem;
  problem.section = section;
  problem.radius_ratio = 0.6;
  problem.bulk.shear_modulus = 8;
  problem.cortex = {.law = CortexLaw::linear, .modulus = 1, .tension = 1};
  problem.accuracy = accuracy;
  return problem;
}

TEST(Threads, AStateIsTheSameBitsForAnyNumberOfThem) {
  for (const auto& problem : {cell_in(Section::square, 2e-2), cell_in(Section::tube, 1e-4)}) {
    const StationaryState alone = solve_stationary(problem);
    ASSERT_EQ(alone.outcome.status, Status::converged);
    for (const int threads : {2, 4}) expect_same(solve_stationary(problem, {}, {nullptr, threads}), alone);
  }
}

}  // namespace
}  // namespace rheocyte::threads_test
