#include "fem/moving_system.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fem/stationary_system.h"
#include "small_channel.h"

namespace rheocyte::moving_system_test {
namespace {

using test::SmallChannel;

/// Viscous, heavier than the liquid, with a cortex: every time term acts.
const Media media{
    {LiquidLaw::power_law, 0.7, 0.1, 0.5}, {BulkLaw::mooney_rivlin, 12, 0.4, 2, 0.8}, {CortexLaw::linear, 8, 0.8, 0}};

Motion some_motion(const Discretisation& space) {
  return {7.0, 0.3 * test::random_vector(space.unknowns(), 3), 0.3 * test::random_vector(2 * space.nodes().count, 4)};
}

TEST(MovingSystem, AtRestItIsTheStationarySystem) {
  // Without rate and history the residuals agree to rounding.
  SmallChannel channel(0.6, 4, media.liquid);
  MovingSystem moving(channel.space);
  const VectorXd x = test::deformed_state(channel.system, media);
  const Residual expected = channel.system.residual(media, x), found = moving.residual(media, x);
  EXPECT_LT((found.value - expected.value).norm() / expected.value.norm(), 1e-13);
  EXPECT_EQ(expected.min_det, found.min_det);
}

TEST(MovingSystem, TheTaylorRemainderOfTheTangentHasSlopeTwo) {
  // At a deformed, moving state in a random direction: halving the step quarters the remainder.
  SmallChannel channel(0.6, 4, media.liquid);
  MovingSystem moving(channel.space);
  const VectorXd x = test::deformed_state(channel.system, media);
  const VectorXd d = test::random_vector(channel.space.unknowns());
  moving.set_motion(some_motion(channel.space));
  const auto remainder = [&](double h) {
    const VectorXd at = moving.residual(media, x).value, beyond = moving.residual(media, x + h * d).value;
    return (beyond - at - h * moving.apply_tangent(media, x, d)).norm();
  };
  double before = remainder(1e-4);
  for (double h = 5e-5; h > 1e-5; h /= 2) {
    const double now = remainder(h);
    EXPECT_NEAR(std::log2(before / now), 2.0, 0.1);
    before = now;
  }
}

TEST(MovingSystem, TheTangentOfAnOpenInletIsExact) {
  // As above where the pressure drop is given: the inlet feels the acceleration of the frame.
  const ChannelMesh mesh(ChannelGeometry(0.6, 12), {});
  const Discretisation space(mesh, 3, media.liquid, Interior::elastic, Drive::pressure_drop);
  MovingSystem moving(space);
  moving.set_motion(some_motion(space));
  const VectorXd x = moving.sphere(), b = test::random_vector(space.unknowns());
  const VectorXd at = moving.linearise(media, x).value;
  ASSERT_TRUE(moving.has_factors());
  EXPECT_LT((moving.apply_tangent(media, x, moving.solve(b)) - b).norm() / b.norm(), 1e-9);
  const auto remainder = [&](double h) {
    return (moving.residual(media, x + h * b).value - at - h * moving.apply_tangent(media, x, b)).norm();
  };
  EXPECT_NEAR(std::log2(remainder(1e-4) / remainder(5e-5)), 2.0, 0.1);
}

TEST(MovingSystem, TheCondensedSystemSolvesTheWholeOne) {
  // K (K^-1 b) = b for random b while everything moves.
  SmallChannel channel(0.6, 4, media.liquid);
  MovingSystem moving(channel.space);
  const VectorXd x = test::deformed_state(channel.system, media);
  moving.set_motion(some_motion(channel.space));
  moving.linearise(media, x);
  ASSERT_TRUE(moving.has_factors());
  const VectorXd b = test::random_vector(channel.space.unknowns(), 2);
  // Condition number near 1e6 times rounding.
  EXPECT_LT((moving.apply_tangent(media, x, moving.solve(b)) - b).norm() / b.norm(), 1e-9);
}

TEST(MovingSystem, AnEvenPressureDoesNotMoveTheMeshOfAFlowingInterior) {
  // Wherever the nodes inside are, the forces on them vanish to rounding against those on the surface. With the points
  // of an elastic interior they did not, and shells folded by them.
  for (const int degree : {4, 5, 8}) {
    SmallChannel channel(0.5, degree, media.liquid, {}, Interior::flowing);
    const Discretisation& space = channel.space;
    MovingSystem moving(space);
    std::vector<int> surface, inside;  // unknowns
    for (const BoundaryEdge& edge : space.surface())
      for (const int node : edge.nodes)
        for (const int c : {0, 1}) surface.push_back(space.displacement(node, c));
    std::erase(surface, -1);
    for (int i = 0; i < 2 * space.nodes().count; ++i) {
      const int u = space.displacement(i / 2, i % 2);
      if (u >= 0 && std::ranges::find(surface, u) == surface.end()) inside.push_back(u);
    }
    VectorXd x = moving.sphere();
    x(inside) = 1e-4 * test::random_vector(int(inside.size()));
    for (std::size_t e = 0; e < space.elements().size(); ++e)
      if (!space.elements()[e].liquid)
        test::set_pressure(
            space, int(e), [](double, double) { return 1.0; }, x);
    const auto [forces, min_det] = moving.residual({media.liquid, {.shear_modulus = 0}, {}}, x);
    EXPECT_GT(min_det, 0);
    const auto greatest = [&](const std::vector<int>& of) { return forces(of).lpNorm<Eigen::Infinity>(); };
    EXPECT_LT(greatest(inside), 1e-12 * greatest(surface)) << degree;
  }
}

TEST(MovingSystem, TheVelocityIsContinuousAcrossTheSurface) {
  // Nodes of the surface move with rate * displacement + history, those of walls with -v_cell.
  SmallChannel channel(0.6);
  MovingSystem moving(channel.space);
  const Motion motion = some_motion(channel.space);
  moving.set_motion(motion);
  const VectorXd x = test::random_vector(channel.space.unknowns());
  const VectorXd velocities = moving.node_velocities(x);
  for (const BoundaryEdge& edge : channel.space.surface()) {
    for (const int node : edge.nodes) {
      const int u = channel.space.displacement(node, 0);
      EXPECT_DOUBLE_EQ(velocities(2 * node), motion.rate * x(u) + motion.unknowns(u));
    }
  }
  for (int node = 0; node < channel.space.nodes().count; ++node) {
    if (channel.space.node_points()[node](1) > 1 - 1e-10) {
      EXPECT_DOUBLE_EQ(velocities(2 * node), -x(channel.space.cell_velocity()));
    }
  }
}

}  // namespace
}  // namespace rheocyte::moving_system_test
