#include "duct/duct_system.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "duct/duct_transfer.h"
#include "duct/observe_duct.h"
#include "taylor.h"

namespace rheocyte::duct_system_test {
namespace {

/// A coarse duct with a cell in it.
struct SmallDuct {
  explicit SmallDuct(const Liquid& liquid, int degree = 2, bool bends = false, Interior interior = Interior::elastic)
      : space(DuctMesh(DuctGeometry(Section::square, 0.6), {.along = 2, .layers = 1, .axial = 1}), degree, liquid,
              Drive::rate, interior),
        system(space, 1, bends) {}
  DuctSpace space;
  DuctSystem system;
};

Media media(const Liquid& liquid) {
  return {.liquid = liquid, .bulk = {.law = BulkLaw::mooney_rivlin, .c1_fraction = 0.3}};
}

/// Some flow round a cell that is deformed by a tenth of its radius.
VectorXd deformed_state(DuctSystem& system, const Media& law) {
  VectorXd state = system.sphere();
  const VectorXd residual = system.linearise(law, state).value;
  EXPECT_TRUE(system.has_factors());
  state += system.solve(-residual);
  system.scale_displacement(0.06 / system.largest_displacement(state), state);
  return state;
}

VectorXd residual(DuctSystem& system, const Media& law, const VectorXd& state) {
  return system.residual(law, state).value;
}

TEST(DuctSystem, TheTaylorRemainderOfTheTangentHasSlopeTwo) {
  // And the factors are the tangent's: each correction leaves as little as single precision allows.
  const Liquid newtonian{.reynolds = 0.7},
      power_law{.law = LiquidLaw::power_law, .exponent = 0.6, .shear_rate_floor = 0.3};
  const Cortex none, shell{CortexLaw::neo_hookean, 2, 0.3, 0}, bent{CortexLaw::thin_shell, 2, 0.3, 0.02},
      elongated{CortexLaw::neo_hookean, 2, 0.3, 0, 1.2, 0.6};
  const Interior solid = Interior::elastic, inside = Interior::liquid;
  for (const auto& [liquid, cortex, interior] : {std::tuple{newtonian, none, solid},
                                                 {power_law, none, solid},
                                                 {newtonian, shell, solid},
                                                 {newtonian, bent, solid},
                                                 {newtonian, shell, inside},
                                                 {newtonian, elongated, solid},
                                                 {newtonian, elongated, inside},
                                                 {power_law, bent, inside}}) {
    SmallDuct duct(liquid, 2, cortex.bending > 0, interior);
    Media law = media(liquid);
    law.cortex = cortex;
    law.bulk.rest_stretch = cortex.rest_stretch;
    law.bulk.axial_tension = cortex.axial_tension;
    const VectorXd x = deformed_state(duct.system, law);
    EXPECT_NEAR(taylor_slope(duct.system, law, x), 2, 0.05);
    const double min_det = duct.system.linearise(law, x).min_det;
    ASSERT_TRUE(duct.system.has_factors());
    EXPECT_GT(min_det, 0);
    const auto [first, corrected] = left_by_factors(duct.system, law, x);
    EXPECT_LT(first, 1e-3);
    EXPECT_LT(corrected, 1e-9);
  }
}

TEST(DuctSystem, TheTangentOfASolidThatStiffensIsExactToo) {
  SmallDuct duct({});
  const Media law{.bulk = {.law = BulkLaw::fung, .stiffening = 2}};
  EXPECT_NEAR(taylor_slope(duct.system, law, deformed_state(duct.system, law)), 2, 0.05);
}

TEST(DuctSystem, LineariseReturnsTheResidual) {
  SmallDuct duct({});
  const Media law = media({});
  const VectorXd x = deformed_state(duct.system, law);
  const auto [r, min_det] = duct.system.linearise(law, x);
  // Up to the rounding of sums in another order.
  const Residual again = duct.system.residual(law, x);
  EXPECT_LT((r - again.value).norm(), 1e-12 * r.norm());
  EXPECT_EQ(min_det, again.min_det);
}

TEST(DuctSystem, GivesUpOnceItIsToStopAndIsWholeAfterwards) {
  SmallDuct duct({});
  const Media law = media({});
  const VectorXd x = duct.system.sphere();
  const VectorXd wanted = duct.system.linearise(law, x).value;
  const VectorXd solved = duct.system.solve(wanted);
  const std::atomic<bool> stop = true;
  duct.system.obey(&stop);
  EXPECT_FALSE(duct.system.linearise(law, x).value.allFinite());
  EXPECT_FALSE(duct.system.has_factors());
  duct.system.obey(nullptr);
  EXPECT_EQ(duct.system.linearise(law, x).value, wanted);
  ASSERT_TRUE(duct.system.has_factors());
  EXPECT_EQ(duct.system.solve(wanted), solved);
}

TEST(DuctSystem, TheUndisturbedFlowSolvesTheEquationsFarFromTheCell) {
  // With the cell's speed as it is, only equations of the layers round the cell, and of the cell, have a residual.
  const Liquid liquid{.law = LiquidLaw::power_law, .exponent = 0.7, .shear_rate_floor = 0.1};
  SmallDuct duct(liquid, 4);
  const DuctSpace& space = duct.space;
  VectorXd x = duct.system.sphere();
  const DuctFlow flow = space.section().flow(liquid);
  const double box = space.mesh().geometry().box();
  for (int i = 0; i < space.nodes().count; ++i) {
    const DuctPoint& X = space.node_points()[i];
    const int unknown = space.velocity(i, 0).unknown;
    if (unknown < 0 || unknown == space.cell_velocity() || std::abs(X(0)) < box - 1e-9) continue;
    x(unknown) = flow.velocity(space.section().node_at(X.tail<2>())) - 1;
  }
  for (int e = 0; e < int(space.elements().size()); ++e) {
    if (space.mesh().elements()[e].part != Part::end) continue;
    // p = -G x on boxes: linear in the third coordinate.
    const VectorXd& points = space.reference().points_1d;
    const int m = int(points.size());
    VectorXd p(space.reference().points());
    for (int q = 0; q < p.size(); ++q)
      p(q) =
          -flow.pressure_gradient * space.mesh().point(e, {points(q % m), points(q / m % m), points(q / (m * m))})(0);
    const VectorXd modes =
        space.reference().pressure.value.transpose() * (space.reference().weights.array() * p.array()).matrix();
    for (int k = 0; k < modes.size(); ++k) x(space.pressure(e, k)) = modes(k);
  }
  const VectorXd r = residual(duct.system, {.liquid = liquid}, x);
  double greatest = 0;
  for (int i = 0; i < space.nodes().count; ++i) {
    for (int c = 0; c < 3; ++c) {
      const int unknown = space.velocity(i, c).unknown;
      if (unknown < 0 || unknown == space.cell_velocity() || std::abs(space.node_points()[i](0)) < box + 1e-9) continue;
      greatest = std::max(greatest, std::abs(r(unknown)));
    }
  }
  EXPECT_LT(greatest, 1e-9);
}

TEST(DuctSpace, TransferToAHigherDegreeKeepsTheShape) {
  const Media law = media({});
  SmallDuct coarse({}, 3), fine({}, 4);
  const VectorXd x = deformed_state(coarse.system, law);
  const VectorXd y = transfer(coarse.space, x, fine.space);
  // Polynomials of a degree are polynomials of the next one; the sphere's own nodes differ by their interpolation.
  EXPECT_NEAR(cell_volume(fine.space, fine.system.element(), y).volume /
                  cell_volume(coarse.space, coarse.system.element(), x).volume,
              1, 2e-3);
  EXPECT_EQ(y(fine.space.cell_velocity()), x(coarse.space.cell_velocity()));
}

}  // namespace
}  // namespace rheocyte::duct_system_test
