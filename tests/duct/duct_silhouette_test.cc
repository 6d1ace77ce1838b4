#include "duct/duct_silhouette.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "duct/duct_system.h"
#include "duct/observe_duct.h"
#include "shape/measures.h"

namespace rheocyte::duct_silhouette_test {
namespace {

constexpr double radius = 0.6;

DuctSpace space_of(Symmetry symmetry, int degree = 5) {
  return DuctSpace(DuctMesh(DuctGeometry(Section::square, radius), {.along = 3, .layers = 1, .axial = 1}, symmetry),
                   degree, {});
}

/// Some smooth body with the symmetry of the square: drawn out along the flow, with a dent in the rear half, its
/// cross-section between circle and square.
DuctPoint body(const DuctPoint& X) {
  const double y = X(1) / radius, z = X(2) / radius, x = X(0) / radius;
  const double corner = 0.2 * y * y * z * z, taper = 1 + 0.1 * x - 0.05 * x * x;
  return {1.1 * X(0), X(1) * taper * (1 + corner), X(2) * taper * (1 + corner)};
}

VectorXd state_of(const DuctSpace& space) {
  VectorXd unknowns = VectorXd::Zero(space.unknowns());
  for (int i = 0; i < space.nodes().count; ++i) {
    for (int c = 0; c < 3; ++c) {
      if (const int unknown = space.displacement(i, c); unknown >= 0)
        unknowns(unknown) = body(space.node_points()[i])(c) - space.node_points()[i](c);
    }
  }
  return unknowns;
}

double deformation(Symmetry symmetry, double degrees, int degree = 5) {
  const DuctSpace space = space_of(symmetry, degree);
  return measure(duct_contour(space, state_of(space), {degrees})).deformation;
}

TEST(DuctSilhouette, ACellAtRestIsRoundAtLowDegrees) {
  // The polynomial faces of degree 3 have a deformation of 3e-6 between their nodes. Between mirror planes the places
  // whose normals are at right angles to the view are those of the faces, an error of second order.
  for (const int degree : {3, 4}) {
    const DuctSpace space = space_of(Symmetry::eighth, degree);
    const auto d = [&](double degrees) {
      return std::abs(measure(duct_contour(space, VectorXd::Zero(space.unknowns()), {degrees})).deformation);
    };
    EXPECT_LT(d(0), 1e-11);
    EXPECT_LT(d(45), 1e-11);
    EXPECT_LT(d(20), 1e-7);
  }
}

TEST(DuctSilhouette, TheEnvelopeInAMirrorPlaneIsTheMeridian) {
  // In the quarter no mirror plane lies along the diagonal, and in the eighth none at 90 degrees.
  EXPECT_NEAR(deformation(Symmetry::quarter, 45) / deformation(Symmetry::eighth, 45), 1, 1e-6);
  EXPECT_EQ(deformation(Symmetry::eighth, 90), deformation(Symmetry::eighth, 0));
  EXPECT_NEAR(deformation(Symmetry::quarter, 90) / deformation(Symmetry::eighth, 0), 1, 1e-12);
}

TEST(DuctSilhouette, AlmostInAMirrorPlaneTheEnvelopeIsAlmostTheMeridian) {
  for (const Symmetry symmetry : {Symmetry::eighth, Symmetry::quarter})
    EXPECT_NEAR(deformation(symmetry, 1e-5) / deformation(symmetry, 0), 1, 1e-6);
  EXPECT_NEAR(deformation(Symmetry::eighth, 45 - 1e-5) / deformation(Symmetry::eighth, 45), 1, 1e-6);
}

TEST(DuctSilhouette, CamerasOnBothSidesOfTheDiagonalSeeTheSame) {
  for (const double degrees : {11.0, 30.0}) {
    EXPECT_NEAR(deformation(Symmetry::eighth, 90 - degrees) / deformation(Symmetry::eighth, degrees), 1, 1e-12);
    EXPECT_NEAR(deformation(Symmetry::quarter, degrees) / deformation(Symmetry::eighth, degrees), 1, 1e-7);
    EXPECT_NEAR(deformation(Symmetry::quarter, 90 - degrees) / deformation(Symmetry::eighth, degrees), 1, 1e-7);
  }
}

TEST(DuctSilhouette, NoPointOfTheBodyLiesBeyondItAndOneOnIt) {
  const DuctSpace space = space_of(Symmetry::eighth);
  const VectorXd state = state_of(space);
  constexpr double degrees = 22.5, angle = degrees * std::numbers::pi / 180;
  for (const double fraction : {-0.7, -0.2, 0.4, 0.9}) {
    // The greatest distance at this height, over a fine grid of the exact body.
    double greatest = 0;
    const double x = fraction * radius, ring = std::sqrt(radius * radius - x * x);
    for (int i = 0; i <= 20000; ++i) {
      const double turn = i * std::numbers::pi / 4 / 20000;
      const DuctPoint at = body({x, ring * std::cos(turn), ring * std::sin(turn)});
      greatest = std::max(greatest, std::cos(angle) * at(1) + std::sin(angle) * at(2));
    }
    const DuctMeridian seen = duct_meridian(space, state, {degrees}, VectorXd::LinSpaced(200, 0, 1));
    double nearest = 1e9, there = 0;
    for (int i = 0; i + 1 < seen.point.rows(); ++i) {
      const double a = seen.point(i, 0) - 1.1 * x, b = seen.point(i + 1, 0) - 1.1 * x;
      if (a * b > 0 || a == b) continue;
      nearest = 0;
      there = (seen.point(i, 1) * b - seen.point(i + 1, 1) * a) / (b - a);
    }
    // The body is interpolated by polynomials of degree 5; 200 points per piece are 1e-5 apart from their chords.
    EXPECT_EQ(nearest, 0) << fraction;
    EXPECT_NEAR(there, greatest, 1e-4 * radius) << fraction;
  }
}

TEST(DuctSilhouette, OfASphereItIsACircleWithItsCurvatureAndNoStretch) {
  const DuctSpace space = space_of(Symmetry::eighth, 7);
  const VectorXd sphere = VectorXd::Zero(space.unknowns());
  for (const double degrees : {0.0, 17.0, 45.0}) {
    const DuctMeridian seen = duct_meridian(space, sphere, {degrees}, VectorXd::LinSpaced(9, 0, 1));
    // Second derivatives of the interpolated sphere.
    EXPECT_LT((seen.curvature.array() * radius - 1).abs().maxCoeff(), 1e-2) << degrees;
    EXPECT_LT((seen.stretch.array() - 1).abs().maxCoeff(), 1e-12) << degrees;
    EXPECT_LT((seen.point.rowwise().norm().array() / radius - 1).abs().maxCoeff(), 1e-6) << degrees;
  }
}

}  // namespace
}  // namespace rheocyte::duct_silhouette_test
