#include "fem/stationary_system.h"

#include <gtest/gtest.h>

#include <vector>

#include "small_channel.h"

namespace rheocyte::stationary_system_test {
namespace {

using test::SmallChannel;

/// Laws, and what fills the cell.
struct Cell {
  Media media;
  Interior interior = Interior::elastic;
  Liquid liquid() const { return media.liquid; }
};

// The floor of 0.1 keeps the power law's third derivatives moderate where the liquid does not shear.
const std::vector<Cell> cells = {
    {{{}, {BulkLaw::linear, 12}}},
    {{{}, {BulkLaw::neo_hookean, 12}}},
    {{{}, {BulkLaw::mooney_rivlin, 12, 0.4}}},
    {{{}, {.law = BulkLaw::fung, .shear_modulus = 12, .stiffening = 0.8}}},
    {{{LiquidLaw::newtonian, 1, 0, 0.5}, {BulkLaw::neo_hookean, 12}}},
    {{{LiquidLaw::power_law, 0.6, 0.1, 0}, {BulkLaw::linear, 12}}},
    {{{LiquidLaw::power_law, 0.6, 0.1, 0.5}, {BulkLaw::mooney_rivlin, 12, 0.4}}},
    {{{LiquidLaw::carreau, 0.5, 0, 0.5, 1.6, 0.1, 1, 2}, {BulkLaw::linear, 12}}},
    {{{}, {BulkLaw::neo_hookean, 12}, {CortexLaw::none, 0, 1, 0.1}}},
    {{{}, {BulkLaw::linear, 12}, {CortexLaw::linear, 8, 0.8, 0}}},
    {{{}, {BulkLaw::neo_hookean, 12}, {CortexLaw::neo_hookean, 8, 0.8, 0.1}}},
    {{{}, {BulkLaw::neo_hookean, 0}, {CortexLaw::linear, 20, 2, 0}}, Interior::liquid},
    {{{}, {BulkLaw::neo_hookean, 0}, {CortexLaw::thin_shell, 20, 2, 0.2}}, Interior::liquid},
    {{{LiquidLaw::power_law, 0.6, 0.1, 0.5}, {BulkLaw::neo_hookean, 0}, {CortexLaw::neo_hookean, 20, 2, 0}},
     Interior::liquid},
    {{{}, {BulkLaw::neo_hookean, 0}, {CortexLaw::neo_hookean_reference, 20, 0, 0}}, Interior::liquid},
    {{{}, {BulkLaw::mooney_rivlin, 12, 0.4, 0, 0, 0, 1.2, 3}, {CortexLaw::neo_hookean, 8, 0.8, 0, 1.2}}},
    {{{}, {BulkLaw::neo_hookean, 12}, {.law = CortexLaw::skalak, .modulus = 8, .tension = 0.8, .area_constant = 5}}},
    {{{}, {BulkLaw::neo_hookean, 0}, {CortexLaw::neo_hookean_reference, 20, 1, 0, 1.2, 3}}, Interior::liquid}};

VectorXd residual(StationarySystem& system, const Media& law, const VectorXd& state) {
  return system.residual(law, state).value;
}

/// || R(x + h d) - R(x) - h K d ||
double taylor_remainder(StationarySystem& system, const Media& law, const VectorXd& x, const VectorXd& d, double h) {
  const VectorXd Kd = system.apply_tangent(law, x, d);
  return (residual(system, law, x + h * d) - residual(system, law, x) - h * Kd).norm();
}

TEST(StationarySystem, TheTaylorRemainderOfTheTangentHasSlopeTwo) {
  // At a deformed state in a random direction, for each law: halving the step quarters the remainder.
  for (const Cell& cell : cells) {
    const Media& law = cell.media;
    SmallChannel channel(0.6, 5, law.liquid, {}, cell.interior);
    const VectorXd x = test::deformed_state(channel.system, law);
    const VectorXd d = test::random_vector(channel.space.unknowns());
    // Random nodal values have slopes near p^2: small enough steps stay in the quadratic range, above rounding.
    double before = taylor_remainder(channel.system, law, x, d, 1e-4);
    for (double h = 5e-5; h > 1e-5; h /= 2) {
      const double now = taylor_remainder(channel.system, law, x, d, h);
      EXPECT_NEAR(std::log2(before / now), 2.0, 0.1);
      before = now;
    }
  }
}

TEST(StationarySystem, TheCondensedSystemSolvesTheWholeOne) {
  // K (K^-1 b) = b for random b, though inner unknowns never reach the sparse matrix.
  for (const Cell& cell : cells) {
    const Media& law = cell.media;
    SmallChannel channel(0.6, 5, law.liquid, {}, cell.interior);
    const VectorXd x = test::deformed_state(channel.system, law);
    channel.system.linearise(law, x);
    ASSERT_TRUE(channel.system.has_factors());
    const VectorXd b = test::random_vector(channel.space.unknowns(), 2);
    const VectorXd solution = channel.system.solve(b);
    // Condition number near 1e6 times rounding.
    EXPECT_LT((channel.system.apply_tangent(law, x, solution) - b).norm() / b.norm(), 1e-9);
  }
}

TEST(StationarySystem, LineariseReturnsTheResidual) {
  // Both ways to evaluate the equations give the same numbers, and the same determinant.
  SmallChannel channel(0.6, 4, cells[5].liquid());
  const VectorXd x = test::deformed_state(channel.system, cells[5].media);
  const Residual one = channel.system.linearise(cells[5].media, x);
  const Residual other = channel.system.residual(cells[5].media, x);
  EXPECT_LT((one.value - other.value).norm() / one.value.norm(), 1e-13);  // dual numbers may round otherwise
  EXPECT_EQ(one.min_det, other.min_det);
}

TEST(StationarySystem, TheResidualIsTheSameInEveryRun) {
  // Same input, same bits: two systems, two evaluations.
  VectorXd first;
  for (int run = 0; run < 3; ++run) {
    SmallChannel channel(0.6);
    const VectorXd x = test::deformed_state(channel.system, cells[1].media);
    const VectorXd r = residual(channel.system, cells[1].media, x);
    if (run == 0) first = r;
    EXPECT_EQ(r, first);
  }
}

TEST(StationarySystem, AFoldedMeshHasANegativeDeterminant) {
  // A cell that is pushed through the wall turns elements inside out; the undeformed mesh has det 1.
  SmallChannel channel(0.6);
  VectorXd x = channel.system.sphere();
  EXPECT_NEAR(channel.system.residual(cells[0].media, x).min_det, 1, 1e-13);
  for (const BoundaryEdge& edge : channel.space.surface()) {
    for (const int node : edge.nodes) {
      if (const int r = channel.space.displacement(node, 1); r >= 0) x(r) = 1;
    }
  }
  EXPECT_LT(channel.system.residual(cells[0].media, x).min_det, 0);
}

TEST(StationarySystem, NumbersThatAreNotFiniteAreNotFactorised) {
  // A NaN in law or state is reported, not solved with.
  SmallChannel channel(0.6);
  const double nan = std::nan("");
  channel.system.linearise({{}, {BulkLaw::neo_hookean, nan}}, channel.system.sphere());
  EXPECT_FALSE(channel.system.has_factors());
  VectorXd x = channel.system.sphere();
  x(channel.space.pressure(0, 1)) = nan;  // inside an element
  channel.system.linearise(cells[0].media, x);
  EXPECT_FALSE(channel.system.has_factors());
}

TEST(StationarySystem, TheWorkMeterCounts) {
  // One factorisation per linearise; meters add up.
  SmallChannel channel(0.6);
  channel.system.linearise(cells[0].media, channel.system.sphere());
  EXPECT_EQ(channel.system.work().factorisations, 1);
  WorkMeter sum = channel.system.work();
  sum += channel.system.work();
  EXPECT_EQ(sum.factorisations, 2);
  EXPECT_DOUBLE_EQ(sum.assembly_s, 2 * channel.system.work().assembly_s);
}

}  // namespace
}  // namespace rheocyte::stationary_system_test
