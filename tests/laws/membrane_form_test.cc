#include "laws/membrane_form.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "laws/surface_form.h"
#include "random_states.h"

namespace rheocyte::membrane_form_test {
namespace {

using test::RandomStates;
using test::states;

constexpr double rounding = 1e-12;
constexpr std::array laws = {CortexLaw::none,
                             CortexLaw::linear,
                             CortexLaw::thin_shell,
                             CortexLaw::neo_hookean,
                             CortexLaw::neo_hookean_reference,
                             CortexLaw::skalak};

/// A patch that was a unit square, with these principal stretches at some angle, somewhere in space.
struct Patch {
  double l1, l2, angle;
  Eigen::Matrix3d turn;

  MembraneFields<double> fields() const {
    const double c = std::cos(angle), s = std::sin(angle);
    Eigen::Matrix2d R;
    R << c, -s, s, c;
    Eigen::Matrix<double, 3, 2> F = Eigen::Matrix<double, 3, 2>::Zero();
    F.topRows<2>() = R * Eigen::Vector2d(l1, l2).asDiagonal() * R.transpose();
    F = turn * F;
    MembraneFields<double> fields;
    fields.s = F.col(0);
    fields.t = F.col(1);
    return fields;
  }
};

Patch random_patch(RandomStates& random) {
  const Eigen::Vector3d axis(random.number(-1, 1), random.number(-1, 1), random.number(0.1, 1));
  return {random.number(0.6, 1.6), random.number(0.6, 1.6), random.number(0, 3),
          Eigen::AngleAxisd(random.number(0, 3), axis.normalized()).toRotationMatrix()};
}

TEST(MembraneForm, TheEnergyIsThatOfThePrincipalStretchesInAnyDirection) {
  RandomStates random;
  for (const CortexLaw law : laws) {
    for (int i = 0; i < states; ++i) {
      const Cortex cortex{law, 3, 0.4, 0};
      const Patch patch = random_patch(random);
      const double expected = (shell_energy(cortex, patch.l1, patch.l2) + cortex.tension) * patch.l1 * patch.l2;
      EXPECT_NEAR((MembranePoint{cortex, {1, 0, 1}}(patch.fields())), expected, rounding * 10);
    }
  }
}

TEST(MembraneForm, ItsForcesAreTheTensionsOfTheMeridian) {
  // With the principal directions along s and t: dW/d(x_s) = T1 l2 e_s.
  RandomStates random;
  for (const CortexLaw law : laws) {
    for (int i = 0; i < states; ++i) {
      const Cortex cortex{law, 3, 0.4, 0};
      const double l1 = random.number(0.6, 1.6), l2 = random.number(0.6, 1.6);
      const auto [T1, T2] = principal_tensions<double>(cortex, l1, l2);
      const auto work =
          value_and_slopes(MembranePoint{cortex, {1, 0, 1}}, std::array{l1, 0.0, 0.0, 0.0, l2, 0.0}).second;
      const std::array expected{T1 * l2, 0.0, 0.0, 0.0, T2 * l1, 0.0};
      for (int k = 0; k < 6; ++k) EXPECT_NEAR(work[k], expected[k], 1e-11);
    }
  }
}

TEST(MembraneForm, WithoutDeformationOnlyTheTensionPulls) {
  // The derivative of the stretches is not unique there; that of their sum is.
  for (const CortexLaw law : laws) {
    const auto work =
        value_and_slopes(MembranePoint{{law, 3, 0.4, 0}, {1, 0, 1}}, std::array{1.0, 0.0, 0.0, 0.0, 1.0, 0.0}).second;
    const std::array expected{0.4, 0.0, 0.0, 0.0, 0.4, 0.0};
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(work[k], expected[k], rounding * 10);
  }
}

TEST(MembraneForm, TheSpheroidThatAShellRestsInHasNoEnergy) {
  // A patch of the sphere, and the same patch of the spheroid as its present shape.
  RandomStates random;
  constexpr double a = 1.3;
  for (int i = 0; i < states; ++i) {
    const Patch patch = random_patch(random);
    const MembraneFields<double> sphere = patch.fields();
    MembraneFields<double> spheroid = sphere;
    for (auto* slope : {&spheroid.s, &spheroid.t})
      *slope = {a * (*slope)(0), (*slope)(1) / std::sqrt(a), (*slope)(2) / std::sqrt(a)};
    const auto part = [](const auto& u, const auto& v, bool along) {
      return along ? u(0) * v(0) : u(1) * v(1) + u(2) * v(2);
    };
    RestMetric rest;
    for (const bool along : {true, false})
      (along ? rest.along : rest.across) = SurfaceMetric<double>{
          part(sphere.s, sphere.s, along), part(sphere.s, sphere.t, along), part(sphere.t, sphere.t, along)};
    EXPECT_NEAR((MembranePoint{{CortexLaw::neo_hookean, 3, 0, 0}, rest.at_rest(a)}(spheroid)), 0, 1e-10);
  }
}

}  // namespace
}  // namespace rheocyte::membrane_form_test
