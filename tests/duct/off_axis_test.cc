// Cells off the axis: shapes that stay while the material turns through them.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "duct/cell_moments.h"
#include "duct/duct_silhouette.h"
#include "duct/duct_system.h"
#include "duct/outline_off_axis.h"
#include "shape/measures.h"
#include "shape/outline_shape.h"
#include "taylor.h"

namespace rheocyte::off_axis_test {
namespace {

constexpr DuctSubdivision coarse{.along = 2, .layers = 1, .axial = 1, .across = 2};

struct HalfDuct {
  HalfDuct(double radius, double offset, int degree, const DuctSubdivision& n = coarse, const Liquid& liquid = {},
           bool bends = false)
      : space(DuctMesh(DuctGeometry(DuctShape{.radius = radius, .offset = offset}), n, Symmetry::half), degree, liquid),
        system(space, 1, bends) {}
  HalfDuct(double radius, int degree, const GivenFlow& flow)
      : space(
            DuctMesh(DuctGeometry(DuctShape{.radius = radius}), {.along = 2, .axial = 1, .across = 2}, Symmetry::half),
            degree, flow),
        system(space) {}
  DuctSpace space;
  DuctSystem system;
};

/// Newton's method without any safeguard; small deformations need none.
VectorXd solved(DuctSystem& system, const Media& media) {
  VectorXd x = system.sphere();
  for (int i = 0; i < 8; ++i) {
    const VectorXd r = system.linearise(media, x).value;
    EXPECT_TRUE(system.has_factors());
    x += system.solve(-r);
    if (system.residual(media, x).value.norm() < 1e-11) break;
  }
  EXPECT_LT(system.residual(media, x).value.norm(), 1e-9);
  return x;
}

TEST(OffAxis, TheTaylorRemainderOfTheTangentHasSlopeTwo) {
  // And the factors are the tangent's: each correction leaves as little as single precision allows. Of a bare solid,
  // and of one with a cortex, which bends, too, in surroundings under tension.
  const Bulk solid{.law = BulkLaw::mooney_rivlin, .c1_fraction = 0.3},
      pulled{.law = BulkLaw::mooney_rivlin, .c1_fraction = 0.3, .axial_tension = 0.5};
  for (const auto& [bulk, cortex] :
       {std::pair{solid, Cortex{}}, std::pair{pulled, Cortex{CortexLaw::neo_hookean, 2, 0.3}},
        std::pair{pulled, Cortex{CortexLaw::neo_hookean, 2, 0.3, 0.02}}}) {
    HalfDuct duct(0.4, 0.2, 2, coarse, {}, cortex.bending > 0);
    const Media media{.liquid = {.reynolds = 0.7}, .bulk = bulk, .cortex = cortex};
    VectorXd x = duct.system.sphere();
    x += duct.system.solve(-duct.system.linearise(media, x).value);
    duct.system.scale_displacement(0.06 / duct.system.largest_displacement(x), x);
    x(duct.space.spin()) += 1;
    EXPECT_NEAR(taylor_slope(duct.system, media, x), 2, 0.05);
    duct.system.linearise(media, x);
    ASSERT_TRUE(duct.system.has_factors());
    const auto [first, corrected] = left_by_factors(duct.system, media, x);
    EXPECT_LT(first, 1e-3);
    EXPECT_LT(corrected, 1e-9);
  }
}

TEST(OffAxis, InSimpleShearAnElasticSphereTurnsAtHalfTheRateAndTakesTheStrainOfSmallDeformations) {
  constexpr double rate = 1, modulus = 100, a = 0.1;
  HalfDuct duct(a, 3, GivenFlow([](const Eigen::Vector2d& at) { return rate * at(0); }));
  const VectorXd x = solved(duct.system, {.bulk = {.shear_modulus = modulus}});
  // Walls at ten radii change the strain by (a/h)^3 about; second order is 1e-4 here.
  EXPECT_NEAR(x(duct.space.spin()) / (-rate / 2), 1, 1e-3);
  EXPECT_NEAR(x(duct.space.drift()), 0, 1e-6);
  const CellMoments moments = cell_moments(duct.space, duct.system.element(), x);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(moments.second);
  const Eigen::Vector3d half_axis = (5 * axes.eigenvalues()).cwiseSqrt() / a;
  const double strain = (half_axis(2) - half_axis(0)) / 2;
  EXPECT_NEAR(strain / (5.0 / 4 * rate / modulus), 1, 6e-3);
  EXPECT_NEAR(half_axis(1), 1, 1e-4);
  // Tilted to 45 degrees but for what the rotation carries along.
  const DuctPoint longest = axes.eigenvectors().col(2);
  EXPECT_NEAR(std::atan2(longest(1), longest(0)) - (longest(0) < 0 ? std::copysign(M_PI, longest(1)) : 0), M_PI / 4,
              0.01);
}

TEST(OffAxis, AtOffsetZeroTheStateIsTheCentredOne) {
  const Media media{.bulk = {.shear_modulus = 30}, .cortex = {CortexLaw::neo_hookean, 2, 0.3, 0.05}};
  // The half has the very elements of the eighth and of its images.
  constexpr DuctSubdivision wedges{.along = 2, .layers = 1, .axial = 1};
  HalfDuct half(0.5, 0, 2, wedges, {}, true);
  DuctSpace space(DuctMesh(DuctGeometry(Section::square, 0.5), wedges), 2, Liquid{});
  DuctSystem eighth(space, 1, true);
  const VectorXd x = solved(half.system, media), y = solved(eighth, media);
  EXPECT_NEAR(x(half.space.cell_velocity()), y(space.cell_velocity()), 1e-8);
  EXPECT_NEAR(x(half.space.drift()), 0, 1e-8);
  EXPECT_NEAR(x(half.space.spin()), 0, 1e-8);
  int compared = 0;
  for (int i = 0; i < space.nodes().count; ++i) {
    if (space.displacement(i, 0) < 0) continue;
    for (int k = 0; k < half.space.nodes().count; ++k) {
      if ((half.space.node_points()[k] - space.node_points()[i]).norm() > 1e-9) continue;
      EXPECT_LT((duct_point(half.space, x, k) - duct_point(space, y, i)).norm(), 1e-8);
      ++compared;
    }
  }
  EXPECT_GT(compared, 50);
}

TEST(OffAxis, ASphereThatIsStretchedAndShearedIsSeenAsTheProjectionOfItsEllipsoid) {
  constexpr double a = 0.4, offset = 0.2, stretch = 1.1, shear = 0.3;
  HalfDuct duct(a, offset, 4);
  const DuctSpace& space = duct.space;
  VectorXd x = duct.system.sphere();
  for (int i = 0; i < space.nodes().count; ++i) {
    const DuctPoint& X = space.node_points()[i];
    if (const int unknown = space.displacement(i, 0); unknown >= 0)
      x(unknown) = (stretch - 1) * X(0) + shear * (X(1) - offset);
  }
  const ShapeMeasures seen = measure(duct_contour(space, x, {90}));
  const double long_axis = std::hypot(stretch, shear);
  // The sphere of degree 4 is one to 1e-4.
  EXPECT_NEAR(seen.area / (M_PI * a * a), long_axis, 2e-4);
  EXPECT_NEAR(seen.inertia_ratio, long_axis, 5e-4);
  EXPECT_NEAR(seen.modes[1], 0, 2e-4);
  // In the plane of the offset, its own section: chords at x have their middle at y = shear x / (stretch^2 + shear^2).
  Polygon outline, ellipse;
  const Eigen::MatrixX2d corners = duct_offset_outline(space, x);
  outline.assign(std::vector<Eigen::Vector2d>(corners.rowwise().begin(), corners.rowwise().end()));
  std::vector<Eigen::Vector2d> exact;
  for (int i = 0; i < 1000; ++i) {
    const double t = 2 * M_PI * i / 1000;
    exact.emplace_back(stretch * std::cos(t) + shear * std::sin(t), std::sin(t));
  }
  ellipse.assign(exact);
  const HullAsymmetry section = hull_asymmetry(outline), wanted = hull_asymmetry(ellipse);
  EXPECT_NEAR(outline.moments().area, M_PI * a * a * stretch, 2e-4);
  EXPECT_NEAR(outline.moments().y, offset, 1e-5);
  EXPECT_NEAR(section.mode_2, wanted.mode_2, 3e-4);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(section.sine_modes[k], wanted.sine_modes[k], 3e-4) << k + 2;
  EXPECT_NEAR(flank_slope(outline, 1), shear / (stretch * stretch + shear * shear), 1e-3);
  const CellMoments moments = cell_moments(space, duct.system.element(), x);
  EXPECT_NEAR(moments.barycentre(1), offset, 1e-12);
  EXPECT_NEAR(5 * moments.second(0, 0) / (a * a), long_axis * long_axis, 1e-4);
  EXPECT_NEAR(5 * moments.second(0, 1) / (a * a), shear, 1e-4);
}

TEST(OffAxis, OnTheOtherSideOfTheAxisDriftAndSpinChangeSign) {
  const Media media{.bulk = {.shear_modulus = 20}};
  HalfDuct above(0.4, 0.2, 2), below(0.4, -0.2, 2);
  const VectorXd x = solved(above.system, media), y = solved(below.system, media);
  EXPECT_GT(std::abs(x(above.space.drift())), 1e-3);
  EXPECT_NEAR(x(above.space.drift()), -y(below.space.drift()), 1e-9);
  EXPECT_NEAR(x(above.space.spin()), -y(below.space.spin()), 1e-9);
  EXPECT_NEAR(x(above.space.cell_velocity()), y(below.space.cell_velocity()), 1e-9);
}

TEST(OffAxis, AnElasticCellDriftsTowardsTheAxisInProportionToItsCompliance) {
  constexpr DuctSubdivision fine{.along = 2, .axial = 1, .across = 2};
  HalfDuct duct(0.4, 0.2, 3, fine);
  const VectorXd stiff = solved(duct.system, {.bulk = {.shear_modulus = 60}}),
                 soft = solved(duct.system, {.bulk = {.shear_modulus = 30}});
  EXPECT_LT(soft(duct.space.drift()), -3e-3);
  EXPECT_NEAR(soft(duct.space.drift()) / stiff(duct.space.drift()), 2, 0.1);
}

TEST(OffAxis, InertiaDrivesAStiffCellFromTheAxisAndTheWallDrivesItBack) {
  const Liquid liquid{.reynolds = 5};
  const Media media{.liquid = liquid, .bulk = {.shear_modulus = 67}};
  const auto drift = [&](double offset) {
    HalfDuct duct(0.4, offset, 3, coarse, liquid);
    return solved(duct.system, media)(duct.space.drift());
  };
  EXPECT_GT(drift(0.1), 3e-3);
  EXPECT_LT(drift(0.5), -1e-2);
}

TEST(OffAxis, TheLiquidsForceAndTorqueOnTheCellVanish) {
  const Liquid liquid{.law = LiquidLaw::power_law, .exponent = 0.8, .shear_rate_floor = 0.3};
  HalfDuct duct(0.4, 0.3, 2, coarse, liquid);
  const Media media{.liquid = liquid, .bulk = {.shear_modulus = 30}};
  const VectorXd x = solved(duct.system, media);
  const DuctSpace& space = duct.space;
  const int n = space.reference().nodes();
  ElementSystem points;
  double largest = 0, torque = 0;
  DuctPoint force = DuctPoint::Zero();
  for (int e = 0; e < int(space.elements().size()); ++e) {
    if (!touches_cell(space.mesh().elements()[e])) continue;
    const VectorXd r =
        integrate_hexahedron({space, duct.system.element(), e, space.elements()[e]}, media, x, Want::residual, points);
    const int on_surface = (space.reference().degree() + 1) * (space.reference().degree() + 1);
    for (int k = 0; k < on_surface; ++k) {
      const DuctPoint at = duct_point(space, x, space.nodes().of_element[e][k]), f(r(k), r(n + k), r(2 * n + k));
      force += f;
      torque += at(0) * f(1) - (at(1) - 0.3) * f(0);
      largest = std::max(largest, f.norm());
    }
  }
  // The half's: across the mirror plane there is one along z.
  EXPECT_GT(largest, 0.01);
  EXPECT_NEAR(force(0), 0, 1e-9);
  EXPECT_NEAR(force(1), 0, 1e-9);
  EXPECT_NEAR(torque, 0, 1e-9);
}

}  // namespace
}  // namespace rheocyte::off_axis_test
