#include "duct/duct_cortex.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "duct/observe_duct.h"

namespace rheocyte::duct_cortex_test {
namespace {

/// A spherical harmonic of a degree, by the direction, and the integral of its square over the whole sphere.
struct Harmonic {
  int degree;
  double square;
  std::function<double(const DuctPoint&)> value;
};

const Harmonic third{3, 4 * std::numbers::pi / 7,
                     [](const DuctPoint& n) { return (5 * n(0) * n(0) * n(0) - 3 * n(0)) / 2; }};
/// With the symmetry of the cube, and so different in both mirror planes of the eighth.
const Harmonic cubic{4, 4 * std::numbers::pi * 16 / 525,
                     [](const DuctPoint& n) { return n.array().pow(4).sum() - 0.6; }};

constexpr double radius = 0.5;

/// All nodes of the cell are moved outward by the harmonic, times the distance from the centre.
VectorXd bulge(const DuctSpace& space, const Harmonic& harmonic) {
  VectorXd change = VectorXd::Zero(space.unknowns());
  for (int node = 0; node < space.nodes().count; ++node) {
    const DuctPoint& X = space.node_points()[node];
    if (X.norm() == 0) continue;
    for (int c = 0; c < 3; ++c) {
      if (const int unknown = space.displacement(node, c); unknown >= 0)
        change(unknown) = harmonic.value(X.normalized()) * X(c);
    }
  }
  return change;
}

/// Work of the cortex's forces in a change.
double work(const DuctCortex& surface, const DuctSpace& space, const Cortex& cortex, const VectorXd& unknowns,
            const VectorXd& change) {
  double sum = 0;
  for (int e = 0; e < int(space.elements().size()); ++e) {
    for (const int patch : surface.patches_of(e)) {
      ElementSystem system;
      surface.integrate(patch, cortex, unknowns, Want::residual, system);
      const Eigen::MatrixXi& of_patch = surface.equations_of(patch);
      for (int i = 0; i < int(of_patch.size()); ++i) {
        if (of_patch(i) >= 0) sum += system.residual(i) * change(of_patch(i));
      }
    }
  }
  return sum;
}

/// Relative error of the bending force on a sphere r0 (1 + e Y): the work of its change in the harmonic Y itself.
double bending_error(const Harmonic& harmonic, Symmetry symmetry, int degree, int along) {
  const DuctSpace space(DuctMesh(DuctGeometry(Section::square, radius), {.along = along, .layers = 1}, symmetry),
                        degree, Liquid{});
  const DuctCortex surface(space, true);
  const Cortex cortex{.bending = 2};
  const VectorXd change = bulge(space, harmonic);
  constexpr double h = 1e-5;
  const double found =
      (work(surface, space, cortex, h * change, change) - work(surface, space, cortex, -h * change, change)) / (2 * h);
  const double l = harmonic.degree, parts = symmetry == Symmetry::eighth ? 8 : 4;
  // docs/theory.md, eq:bending-mode, times the displacement r0 Y, over this part of the sphere.
  const double exact = cortex.bending / 4 * (l - 1) * l * (l + 1) * (l + 2) * harmonic.square / parts;
  return std::abs(found / exact - 1);
}

TEST(DuctCortex, TheBendingForceConvergesToTheExactLinearOne) {
  for (const Harmonic& harmonic : {third, cubic}) {
    for (const Symmetry symmetry : {Symmetry::eighth, Symmetry::quarter}) {
      double before = 1;
      for (const int degree : {3, 4, 5, 6}) {
        const double error = bending_error(harmonic, symmetry, degree, 3);
        EXPECT_LT(error, 0.3 * before);
        before = error;
      }
      EXPECT_LT(before, 1e-4);
    }
  }
}

TEST(DuctCortex, ARigidMotionAlongTheFlowDoesNoWork) {
  const DuctSpace space(DuctMesh(DuctGeometry(Section::square, radius), {.along = 2, .layers = 1}), 3, Liquid{});
  const DuctCortex surface(space, true);
  VectorXd shift = VectorXd::Zero(space.unknowns());
  for (int node = 0; node < space.nodes().count; ++node) {
    if (const int unknown = space.displacement(node, 0); unknown >= 0) shift(unknown) = 1;
  }
  const VectorXd state = 0.1 * bulge(space, third);
  const Cortex cortex{CortexLaw::neo_hookean, 2, 0.3, 0.1};
  EXPECT_NEAR(work(surface, space, cortex, state, shift), 0, 1e-11);
}

TEST(DuctCortex, TheSurfaceOfALiquidInteriorHasTheVolumeThatTheInteriorHas) {
  // The one equation of the inner pressure is a sum over the faces; the volume itself is an integral over the interior.
  for (const Symmetry symmetry : {Symmetry::eighth, Symmetry::quarter}) {
    const DuctSpace space(DuctMesh(DuctGeometry(Section::square, radius), {.along = 2, .layers = 1}, symmetry), 4,
                          Liquid{}, Drive::rate, Interior::liquid);
    const DuctCortex surface(space, false);
    const VectorXd sphere = VectorXd::Zero(space.unknowns()), state = 0.1 * bulge(space, third);
    VectorXd pressure = sphere;
    pressure(space.inner_pressure()) = 1;
    const TensorElement element(space.reference());
    const double lost = cell_volume(space, element, sphere).volume - cell_volume(space, element, state).volume,
                 parts = symmetry == Symmetry::eighth ? 8 : 4;
    EXPECT_GT(std::abs(lost), 1e-3);
    EXPECT_NEAR(parts * work(surface, space, {}, state, pressure), lost, 1e-12);
  }
}

TEST(DuctCortex, LaplacesPressureHoldsTheSphere) {
  const DuctSpace space(DuctMesh(DuctGeometry(Section::square, radius), {.along = 2, .layers = 1}), 6, Liquid{},
                        Drive::rate, Interior::liquid);
  const DuctCortex surface(space, false);
  const VectorXd sphere = VectorXd::Zero(space.unknowns());
  const Cortex cortex{CortexLaw::neo_hookean, 2, 0.3, 0};
  for (const Harmonic& harmonic : {third, cubic})
    EXPECT_NEAR(work(surface, space, cortex, sphere, bulge(space, harmonic)), 0, 1e-7);
}

}  // namespace
}  // namespace rheocyte::duct_cortex_test
