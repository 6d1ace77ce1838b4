#include "fem/observe.h"

#include <gtest/gtest.h>

#include "shape/measures.h"
#include "small_channel.h"

namespace rheocyte::observe_test {
namespace {

using test::SmallChannel;

constexpr double rounding = 1e-12;  // interpolation of fields of order one

TEST(Observe, TheSphereIsNotStretched) {
  // All stretches and the Biot ratio of the undeformed cell are one.
  SmallChannel channel(0.6);
  const SurfaceState surface = surface_state(channel.space, channel.system.sphere(), 9);
  EXPECT_LT((surface.stretch.col(0).array() - 1).abs().maxCoeff(), rounding);
  EXPECT_LT((surface.stretch.col(1).array() - 1).abs().maxCoeff(), rounding);
  EXPECT_NEAR(min_biot_ratio(surface), 1, rounding);
}

TEST(Observe, AUniformStretchIsSeenInBothDirections) {
  // x -> (2 x, r / sqrt(2)): at the equator the meridian is stretched by 2, the hoop by 1/sqrt(2); at the poles both by
  // 1/sqrt(2). The Biot ratio meridional^2 hoop is least there: 2^(-3/2).
  SmallChannel channel(0.6);
  VectorXd state = channel.system.sphere();
  for (int node = 0; node < channel.space.nodes().count; ++node) {
    const Point X = channel.space.node_points()[node];
    if (const int i = channel.space.displacement(node, 0); i >= 0) state(i) = X(0);
    if (const int i = channel.space.displacement(node, 1); i >= 0) state(i) = (1 / std::sqrt(2.0) - 1) * X(1);
  }
  const SurfaceState surface = surface_state(channel.space, state, 9);
  const Eigen::Index middle = surface.stretch.rows() / 2;
  // Degree 4 interpolates the circle with a relative error near 1e-5 in its slopes.
  EXPECT_NEAR(surface.stretch(0, 0), 1 / std::sqrt(2.0), 1e-4);
  EXPECT_NEAR(surface.stretch(middle, 0), 2, 1e-4);
  EXPECT_NEAR(surface.stretch(middle, 1), 1 / std::sqrt(2.0), rounding);
  EXPECT_NEAR(min_biot_ratio(surface), std::pow(2, -1.5), 1e-4);
}

TEST(Observe, TheBiotLimitIsTheRootOfItsCubic) {
  // x^3 + x^2 + 3 x = 1.
  constexpr double x = biot_limit;
  EXPECT_NEAR(x * x * x + x * x + 3 * x, 1, 1e-15);  // rounding of a constant written with 16 digits
}

TEST(Observe, TheContourOfTheSphereIsItsMeridian) {
  // From front pole to rear pole, deformation zero, area of the circle.
  SmallChannel channel(0.6, 8);
  const Contour curve = contour(channel.space, channel.system.sphere());
  EXPECT_EQ(curve.pieces.front()(0, 1), 0);
  EXPECT_NEAR(curve.pieces.front()(0, 0), 0.6, rounding);
  EXPECT_EQ(curve.pieces.back()(8, 1), 0);
  const ShapeMeasures shape = measure(curve);
  // Interpolation of arcs of 22.5 degrees by degree 8.
  EXPECT_NEAR(shape.deformation, 0, 1e-10);
  EXPECT_NEAR(shape.area, M_PI * 0.36, 1e-10);
}

TEST(Observe, TheInletPressureIsTheMeanOverTheArea) {
  // p = 3 + r^2 has the mean 3.5 over the inlet.
  SmallChannel channel(0.6);
  VectorXd state = channel.system.sphere();
  for (int e = 0; e < int(channel.space.elements().size()); ++e) {
    test::set_pressure(
        channel.space, e, [](double, double r) { return 3 + r * r; }, state);
  }
  EXPECT_NEAR(end_pressure(channel.space, state, ChannelEnd::upstream), 3.5, rounding);
}

TEST(Observe, DisplacementsAreScaledAlone) {
  // scale_displacement touches neither velocity nor pressure.
  SmallChannel channel(0.6);
  const VectorXd before = test::random_vector(channel.space.unknowns());
  VectorXd after = before;
  scale_displacement(channel.space, 0.5, after);
  EXPECT_DOUBLE_EQ(largest_displacement(channel.space, after), 0.5 * largest_displacement(channel.space, before));
  EXPECT_EQ(after(channel.space.cell_velocity()), before(channel.space.cell_velocity()));
  EXPECT_EQ(after(channel.space.pressure(0, 0)), before(channel.space.pressure(0, 0)));
}

TEST(Transfer, AHigherDegreeAndBackIsTheIdentity) {
  // Every field of degree 4 lies in the space of degree 7 on the same mesh.
  const SmallChannel coarse(0.6, 4), fine(0.6, 7);
  VectorXd state = test::random_vector(coarse.space.unknowns());
  const VectorXd back = transfer(fine.space, transfer(coarse.space, state, fine.space), coarse.space);
  EXPECT_LT((back - state).cwiseAbs().maxCoeff(), 10 * rounding);
}

TEST(Transfer, TheCellIsTheSameOnANestedMesh) {
  // Halved elements of the cell represent its displacement and pressure, and carry them back.
  const SmallChannel coarse(0.6, 5, {}, {2, 4, 1, 2}), fine(0.6, 5, {}, {4, 8, 2, 4});
  VectorXd state = test::random_vector(coarse.space.unknowns());
  const VectorXd back = transfer(fine.space, transfer(coarse.space, state, fine.space), coarse.space);
  for (int i = 0; i < 2 * coarse.space.nodes().count; ++i) {
    const int unknown = coarse.space.displacement(i / 2, i % 2);
    EXPECT_NEAR(unknown < 0 ? 0 : back(unknown) - state(unknown), 0, 10 * rounding);
  }
  for (int e = 0; e < int(coarse.space.elements().size()); ++e) {
    if (coarse.space.elements()[e].liquid) continue;
    for (int k = 0; k < coarse.space.reference().pressures(); ++k) {
      const int unknown = coarse.space.pressure(e, k);
      EXPECT_NEAR(back(unknown), state(unknown), 10 * rounding);
    }
  }
}

TEST(Transfer, TheShapeDoesNotChangeOnOtherMeshes) {
  // The deformation of a smooth state is the same after a transfer, up to the circle's interpolation (1e-9 at degree
  // 8).
  SmallChannel channel(0.6, 8), other(0.6, 8, {}, {3, 6, 1, 3});
  const VectorXd state = test::deformed_state(channel.system, {{}, {BulkLaw::neo_hookean, 12}});
  const VectorXd moved = transfer(channel.space, state, other.space);
  const double before = measure(contour(channel.space, state)).deformation;
  EXPECT_NEAR(measure(contour(other.space, moved)).deformation / before, 1, 1e-4);
  EXPECT_EQ(moved(other.space.cell_velocity()), state(channel.space.cell_velocity()));
}

TEST(Transfer, DisplacementsAreThoseOfTheSameMaterialWhereTheCoreIsCutOtherwiseAtTheAxis) {
  // A cubic displacement of the undeformed places, between meshes whose lines through the core lean: up to what
  // elements of degree 8 leave of it.
  const ChannelGeometry geometry(0.6);
  const std::vector<double> even{0, 0.25, 0.5, 0.75, 1}, rim{0, 0.4, 0.7, 0.85, 1};
  const ChannelMesh plain(geometry, {}, {{0, 0.5, 1}, even, {}}), leaning(geometry, {}, {{0, 0.5, 1}, rim, even});
  const Discretisation from(plain, 8, {}), to(leaning, 8, {});
  const auto displaced = [](const Discretisation& space) {
    VectorXd state = VectorXd::Zero(space.unknowns());
    for (int node = 0; node < space.nodes().count; ++node) {
      const Point X = space.node_points()[node];
      const Point u{X(0) * X(0) - X(1) * X(1) * X(0), X(1) * X(0)};
      for (int c = 0; c < 2; ++c)
        if (const int unknown = space.displacement(node, c); unknown >= 0) state(unknown) = u(c);
    }
    return state;
  };
  for (const auto& [a, b] : {std::pair{&from, &to}, {&to, &from}}) {
    const VectorXd moved = transfer(*a, displaced(*a), *b), wanted = displaced(*b);
    for (int i = 0; i < 2 * b->nodes().count; ++i)
      if (const int unknown = b->displacement(i / 2, i % 2); unknown >= 0) {
        EXPECT_NEAR(moved(unknown), wanted(unknown), 1e-6);
      }
  }
}

}  // namespace
}  // namespace rheocyte::observe_test
