// The deformation converges exponentially in the degree of the polynomials, and meshes agree on the limit.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "laboratory.h"
#include "shape/measures.h"
#include "solve/resolved_branch.h"

namespace rheocyte {
namespace {

constexpr Subdivision coarse_mesh{2, 4, 1, 2}, fine_mesh{4, 8, 2, 2};

/// r0 = 6 um, E = 2.29 kPa, `linear`, Stokes: d = 0.0382, a case with a narrow rear shoulder.
class Convergence : public testing::Test {
 protected:
  Convergence() {
    options_.tolerance = 1e-12;
    state_ = follow_branch(problem_, options_, {});
  }

  double deformation(const Subdivision& subdivision, int degree) {
    const ResolvedState resolved = at_resolution(problem_, options_, state_, {subdivision, degree});
    EXPECT_EQ(resolved.status, Status::converged);
    return measure(contour(resolved.discrete->space, resolved.branch.unknowns)).deformation;
  }

 private:
  Problem problem_ = test::in_newtonian_liquid({6, 2.29, BulkLaw::linear}, test::Inertia::none, 1e-6);
  NewtonOptions options_;
  ResolvedState state_;
};

TEST_F(Convergence, EachDegreeReducesTheErrorThreefoldAndAMillionthIsReached) {
  // Coarse mesh, degrees 4 to 8, against degree 9 on the fine mesh.
  const double limit = deformation(fine_mesh, 9);
  double error = 0;
  for (int degree = 4; degree <= 8; ++degree) {
    const double last = error;
    error = std::abs(deformation(coarse_mesh, degree) / limit - 1);
    if (degree == 4) continue;
    EXPECT_LT(error, last / 3) << "degree " << degree;  // wanted of the program
  }
  EXPECT_LT(error, 1e-6);  // wanted of the program
}

}  // namespace
}  // namespace rheocyte
