#include "fem/surface_integrals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "small_channel.h"

namespace rheocyte::surface_integrals_test {
namespace {

using test::SmallChannel;

constexpr double radius = 0.6;

struct Shell : SmallChannel {
  explicit Shell(int degree, const Subdivision& n = {}) : SmallChannel(radius, degree, {}, n, Interior::liquid) {}
};

/// The residual that the surface alone makes at a state.
VectorXd surface_residual(Shell& shell, const Cortex& cortex, const VectorXd& state) {
  const Media with{{}, {BulkLaw::neo_hookean, 0}, cortex}, without{{}, {BulkLaw::neo_hookean, 0}, {}};
  return shell.system.residual(with, state).value - shell.system.residual(without, state).value;
}

/// A displacement of the surface along the radius by a function of the angle.
template <class Function>
VectorXd radial(const Discretisation& space, const Function& u) {
  VectorXd field = VectorXd::Zero(space.unknowns());
  for (const BoundaryEdge& edge : space.surface()) {
    for (const int node : edge.nodes) {
      const Point X = space.node_points()[node] / radius;
      for (int c = 0; c < 2; ++c) {
        if (const int unknown = space.displacement(node, c); unknown >= 0) field(unknown) = radius * u(X(0)) * X(c);
      }
    }
  }
  return field;
}

TEST(SurfaceIntegrals, ASphereUnderTensionHasThePressureOfLaplaceAndDoesNotMove) {
  // With p = 2 gamma/r0 inside, which the equations contain, no equation is left over; and the pressure that
  // holds the sphere against inflation is that one. 1e-10 at degree 9; the rest is that of a polynomial sphere.
  Shell shell(9);
  constexpr double gamma = 1.7;
  const Cortex cortex{CortexLaw::neo_hookean, 5, gamma, 0};
  const VectorXd sphere = shell.system.sphere();
  EXPECT_LT(surface_residual(shell, cortex, sphere).lpNorm<Eigen::Infinity>(), 1e-10 * gamma);
  const VectorXd inflation = radial(shell.space, [](double) { return 1.0; });
  VectorXd pressed = sphere;
  pressed(shell.space.inner_pressure()) = 1;
  const double tension_work = inflation.dot(surface_residual(shell, cortex, sphere));
  const Media no_cortex{{}, {BulkLaw::neo_hookean, 0}, {}};
  const double pressure_work =
      inflation.dot(shell.system.residual(no_cortex, pressed).value - shell.system.residual(no_cortex, sphere).value);
  const double pressure = 2 * gamma / radius - tension_work / pressure_work;
  EXPECT_NEAR(pressure / (2 * gamma / radius), 1, 1e-10);
}

TEST(SurfaceIntegrals, TheVolumeOfAShellIsConstrained) {
  // The equation of the inner pressure is the change of volume per radian; 0 for the sphere.
  Shell shell(6);
  const int row = shell.space.inner_pressure();
  const VectorXd sphere = shell.system.sphere();
  EXPECT_NEAR(shell.system.residual({}, sphere).value(row), 0, 1e-14);
  const VectorXd larger = sphere + radial(shell.space, [](double) { return 0.1; });
  EXPECT_NEAR(shell.system.residual({}, larger).value(row), -2.0 / 3 * std::pow(radius, 3) * (std::pow(1.1, 3) - 1),
              1e-7);  // the sphere of degree 6 on 8 edges
}

/// Relative error of the bending force on a sphere r0 (1 + e P_3): the work of its change on P_3.
double bending_error(int degree, int refinement) {
  Shell shell(degree, {2 * refinement, 4 * refinement, 1, 2});
  const Cortex cortex{CortexLaw::none, 0, 0, 1};
  constexpr int l = 3;
  const VectorXd mode = radial(shell.space, [](double x) { return std::legendre(l, x); });
  const double e = 1e-4;  // central difference: error e^2
  const VectorXd sphere = shell.system.sphere();
  const double work = mode.dot(surface_residual(shell, cortex, sphere + e * mode) -
                               surface_residual(shell, cortex, sphere - e * mode)) /
                      (2 * e);
  // Per radian: c_b/4 (l-1) l (l+1) (l+2) int P_l^2 sin(theta) d(theta) (docs/theory.md, eq:bending-mode).
  const double exact = 0.25 * (l - 1) * l * (l + 1) * (l + 2) * 2 / (2 * l + 1);
  return std::abs(work / exact - 1);
}

TEST(SurfaceIntegrals, TheBendingForceConvergesToTheExactLinearOne) {
  // Twice the order of the curvature, 2 (p - 1): the force is tested with a smooth field.
  for (const int degree : {3, 4}) {
    const double coarse = bending_error(degree, 2), fine = bending_error(degree, 4);
    RecordProperty("order", std::to_string(std::log2(coarse / fine)));
    EXPECT_GT(std::log2(coarse / fine), 2 * (degree - 1) - 0.3) << coarse << " " << fine;
  }
  EXPECT_LT(bending_error(8, 2), 1e-7);  // central difference of 1e-8
}

}  // namespace
}  // namespace rheocyte::surface_integrals_test
