#include "duct/moving_duct_system.h"

#include <gtest/gtest.h>

#include <cmath>

#include "taylor.h"

namespace rheocyte::moving_duct_system_test {
namespace {

/// A coarse duct whose wall is somewhere on the way, with a cell that moves.
struct SmallDuct {
  explicit SmallDuct(Section section = Section::square, Symmetry symmetry = Symmetry::quarter)
      : space(DuctMesh(DuctGeometry(section, 0.6), {.along = 2, .layers = 1, .axial = 1}, symmetry), 2, Liquid{}),
        system(space) {}

  /// A wall of half widths 1 + slope x.
  VectorXd move_wall(double slope, const VectorXd& unknowns) {
    VectorXd outward = space.wall_motion([&](double x) { return 1 + 0.2 + slope * x; }, unknowns);
    space.move_nodes(outward);
    return outward;
  }

  DuctSpace space;
  MovingDuctSystem system;
};

Media media() {
  return {.liquid = {},
          .bulk = {.law = BulkLaw::mooney_rivlin, .mooney_share = 0.3, .viscosity = 2},
          .cortex = {CortexLaw::neo_hookean, 2, 0.3, 0}};
}

/// Some flow round a cell that is deformed by a tenth of its radius.
VectorXd deformed_state(MovingDuctSystem& system, const Media& law) {
  VectorXd state = system.sphere();
  state += (system.linearise(law, state), system.solve(-system.residual(law, state).value));
  system.scale_displacement(0.06 / system.largest_displacement(state), state);
  return state;
}

TEST(MovingDuctSystem, TheTaylorRemainderOfTheTangentHasSlopeTwo) {
  // With a viscosity beside the solid and in series with a spring, in a slanted wall.
  for (const double branch_modulus : {0.0, 3.0}) {
    SmallDuct duct;
    Media law = media();
    law.bulk.branch_modulus = branch_modulus;
    const VectorXd state = deformed_state(duct.system, law);
    Motion motion{3, -2.7 * state, {}, duct.move_wall(-0.05, state), {}};
    if (branch_modulus > 0) motion.branch = -2.5 * duct.system.unstressed_branch();
    duct.system.set_motion(motion);
    EXPECT_NEAR(taylor_slope(duct.system, law, state), 2, 0.05) << branch_modulus;
  }
}

TEST(MovingDuctSystem, AtRestItsResidualIsThatOfTheStationarySystem) {
  // To rounding, with whatever viscosity, on the mesh of a wall that is not straight.
  SmallDuct duct;
  const Media law = media();
  const VectorXd state = deformed_state(duct.system, law);
  const VectorXd outward = duct.move_wall(-0.05, state);
  duct.system.set_motion({0, 0 * state, {}, outward, {}});
  DuctSystem stationary(duct.space);
  const VectorXd expected = stationary.residual(law, state).value;
  EXPECT_LT((duct.system.residual(law, state).value - expected).norm(), 1e-12 * expected.norm());
}

TEST(MovingDuctSystem, AnUnstressedBranchOfACellAtRestStaysSo) {
  SmallDuct duct;
  const Media law{.bulk = {.viscosity = 2, .branch_modulus = 3}};
  const VectorXd sphere = 0 * duct.system.sphere(), unstressed = duct.system.unstressed_branch();
  Motion motion{5, sphere, {}, {}, -5 * unstressed};  // d/dt = 0
  duct.system.set_motion(motion);
  EXPECT_LT((duct.system.branch_metric(law.bulk, sphere) - unstressed).lpNorm<Eigen::Infinity>(), 1e-14);
}

TEST(MovingDuctSystem, NodesOnTheWallStayOnItAndThoseOfTheCellAndTheAxisStayWhereTheyAre) {
  // In a planar funnel along y alone, in a round one in both directions.
  for (const Section section : {Section::square, Section::tube}) {
    SmallDuct duct(section);
    const std::vector<DuctPoint> before = duct.space.node_points();
    const auto wall = [](double x) { return 1.2 - 0.05 * x; };
    duct.move_wall(-0.05, VectorXd::Zero(duct.space.unknowns()));
    for (int i = 0; i < duct.space.nodes().count; ++i) {
      const DuctPoint &x = before[i], &now = duct.space.node_points()[i];
      EXPECT_EQ(now(0), x(0));
      if (section == Section::square) {
        EXPECT_EQ(now(2), x(2));
        if (std::abs(x(1) - 1) < 1e-9) {
          EXPECT_NEAR(now(1), wall(x(0)), 1e-12);
        }
      } else if (duct.space.mesh().geometry().is_wall(x)) {
        EXPECT_NEAR(now.tail<2>().norm(), wall(x(0)), 1e-9);
      }
      if (x(1) == 0) {
        EXPECT_EQ(now(1), 0);
      }
      if (duct.space.displacement(i, 2) >= 0) {
        EXPECT_EQ(now, x);
      }
    }
  }
}

}  // namespace
}  // namespace rheocyte::moving_duct_system_test
