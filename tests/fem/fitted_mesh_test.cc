#include "fem/fitted_mesh.h"

#include <gtest/gtest.h>

#include <random>

#include "fem/fit_liquid.h"
#include "fem/node_numbers.h"
#include "laws/mesh_form.h"
#include "shape/curve.h"
#include "small_channel.h"

namespace rheocyte::fitted_mesh_test {
namespace {

using test::SmallChannel;

/// The unit square, of 3 x 3 elements, whose boundary stays.
struct Square {
  explicit Square(int degree) : reference(degree) {
    const VectorXd& s = lobatto_nodes(degree);
    const int n = degree + 1;
    const auto point = [&](int e, int k) {
      return Eigen::Vector2d((e % 3 + s(k % n)) / 3, (e / 3 + s(k / n)) / 3);  // NOLINT(bugprone-integer-division)
    };
    const NodeNumbers numbers = number_nodes<2>(9, n * n, point);
    mesh.elements = numbers.of_element;
    mesh.rest = MatrixXd(numbers.count, 2);
    for (int e = 0; e < 9; ++e)
      for (int k = 0; k < n * n; ++k) mesh.rest.row(numbers.of_element[e][k]) = point(e, k).transpose();
    for (int i = 0; i < numbers.count; ++i) {
      const bool is_inside = (mesh.rest.row(i).array() > 1e-9).all() && (mesh.rest.row(i).array() < 1 - 1e-9).all();
      for (int& unknown : mesh.unknown.emplace_back()) unknown = is_inside ? mesh.unknowns++ : -1;
    }
  }
  /// The places with the nodes inside moved by at most so much.
  MatrixXd shaken(MatrixXd places, double by) const {
    std::mt19937 engine(1);
    std::uniform_real_distribution<double> move(-by, by);
    for (int i = 0; i < places.rows(); ++i)
      for (int c = 0; c < 2; ++c) places(i, c) += mesh.unknown[i][c] < 0 ? 0 : move(engine);
    return places;
  }
  ReferenceElement<2> reference;
  MovableMesh<2> mesh{reference, {}, {}, {}, 0};
};

TEST(FittedMesh, ASimilarityIsNoDistortion) {
  // Rotation by 0.7 and magnification by 3, in the plane and, about an axis, in space: 1. A stretch by a in one of two
  // directions: ((a + 1/a) / 2)^2; in one of three: ((a^2 + 2) / (3 a^(2/3)))^2.
  const double c = 3 * std::cos(0.7), s = 3 * std::sin(0.7), a = 1.7;
  EXPECT_NEAR(distortion(Matrix<double, 2, 2>{c, -s, s, c}), 1, 1e-14);
  EXPECT_NEAR(distortion(Matrix<double, 3, 3>{c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 3.0}), 1, 1e-14);
  EXPECT_NEAR(distortion(Matrix<double, 2, 2>{a, 0.0, 0.0, 1.0}), std::pow((a + 1 / a) / 2, 2), 1e-14);
  EXPECT_NEAR(distortion(Matrix<double, 3, 3>{a, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}),
              std::pow((a * a + 2) / (3 * std::pow(a, 2.0 / 3)), 2), 1e-14);
}

TEST(FittedMesh, AShakenMeshComesToRest) {
  // Inner nodes moved at random by some per cent of the elements' width, at low and high degree. The least distorted
  // mesh is the one at rest, found to a fraction of the tolerance of its distortion.
  for (const int degree : {1, 3, 5}) {
    const Square square(degree);
    const MatrixXd shaken = square.shaken(square.mesh.rest, 0.1 / (3 * degree * degree));
    const MatrixXd fitted = fitted_places(square.mesh, shaken);
    EXPECT_LT(mesh_quality(square.mesh, shaken), 0.99);
    EXPECT_GT(mesh_quality(square.mesh, fitted), 0.9999);
    EXPECT_LT((fitted - square.mesh.rest).cwiseAbs().maxCoeff(), 1e-3);
  }
}

TEST(FittedMesh, AShearedBoundaryShearsTheMesh) {
  // The boundary is sheared by 1 and the inside with it, but shaken: of all meshes the evenly sheared one is the least
  // distorted, everywhere by ((2 + 1) / 2)^2.
  const Square square(3);
  MatrixXd sheared = square.mesh.rest;
  sheared.col(0) += square.mesh.rest.col(1);
  const MatrixXd fitted = fitted_places(square.mesh, square.shaken(sheared, 0.01));
  EXPECT_LT((fitted - sheared).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_NEAR(mesh_quality(square.mesh, fitted), 4.0 / 9, 5e-3);
}

TEST(FittedMesh, AFoldedMeshIsLeftAsItIs) {
  // One inner node is moved out of the square.
  const Square square(1);
  MatrixXd folded = square.mesh.rest;
  const auto inside = std::ranges::find_if(square.mesh.unknown, [](const auto& u) { return u[0] >= 0; });
  folded(inside - square.mesh.unknown.begin(), 0) += 2;
  EXPECT_EQ(mesh_quality(square.mesh, folded), 0);
  EXPECT_EQ(fitted_places(square.mesh, folded), folded);
}

TEST(FittedMesh, OnlyTheLiquidMoves) {
  // A cell displaced by 0.4 of its radius: the mesh round it becomes better; points of the cell, of the channel's ends,
  // and the distances of wall and axis stay.
  Media media;
  media.bulk.shear_modulus = 10;
  SmallChannel channel(0.6);
  const VectorXd state = test::deformed_state(channel.system, media, 0.4);
  const std::vector<Point> before = channel.space.node_points(), after = fitted_points(channel.space, state);
  const double quality = liquid_mesh_quality(channel.space, state), end = channel.mesh.geometry().end();
  channel.space.set_points(after);
  EXPECT_GT(liquid_mesh_quality(channel.space, state), 1.1 * quality);
  for (int i = 0; i < int(before.size()); ++i) {
    const bool stays = channel.space.displacement(i, 0) >= 0 || std::abs(before[i](0)) > end - 1e-9;
    if (stays) {
      EXPECT_EQ(after[i], before[i]);
    }
    if (before[i](1) < 1e-9 || before[i](1) > 1 - 1e-9) {
      EXPECT_NEAR(after[i](1), before[i](1), 1e-12);
    }
  }
}

TEST(FittedMesh, PointsAreTransferredToFinerMeshes) {
  // To the same mesh exactly; to a finer one of a higher degree so that the mesh round the cell is about as good.
  Media media;
  media.bulk.shear_modulus = 10;
  SmallChannel channel(0.6, 5), finer(0.6, 7, {}, {3, 6, 1, 2});
  const VectorXd state = test::deformed_state(channel.system, media, 0.4);
  const std::vector<Point> points = fitted_points(channel.space, state);
  channel.space.set_points(points);
  const SmallChannel again(0.6, 5);
  const std::vector<Point> same = transferred_points(channel.space, again.space);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT((same[i] - points[i]).norm(), 1e-12);
  finer.space.set_points(transferred_points(channel.space, finer.space));
  const double quality = liquid_mesh_quality(channel.space, state);
  EXPECT_GT(liquid_mesh_quality(finer.space, transfer(channel.space, state, finer.space)), 0.7 * quality);
}

TEST(FittedMesh, ElementsOfASphereAreEven) {
  // 8 elements on top, unevenly cut: those that are even on the sphere.
  const ChannelGeometry geometry(0.6);
  const ChannelMesh mesh(geometry, {}, SurfaceBreaks{{0, 0.4, 1}, {0, 0.05, 0.1, 0.2, 0.5, 0.6, 0.7, 0.8, 1}});
  const Discretisation space(mesh, 6, {});
  const StationarySystem system(space);
  const SurfaceBreaks breaks = fitted_breaks(space, system.sphere());
  for (int k = 0; k <= 8; ++k) EXPECT_NEAR(breaks.top[k], k / 8.0, 1e-3);
  EXPECT_EQ(breaks.front, mesh.breaks().front);
  EXPECT_EQ(breaks.axis, mesh.breaks().top);  // in the middle of the cell elements stay as wide as they were
}

}  // namespace
}  // namespace rheocyte::fitted_mesh_test
