#include "fem/discretisation.h"

#include <gtest/gtest.h>

#include <map>

#include "laws/developed_flow.h"
#include "laws/wall_profile.h"
#include "small_channel.h"

namespace rheocyte::discretisation_test {
namespace {

using test::SmallChannel;

constexpr double rounding = 1e-13;  // a few operations on lengths of order one

TEST(Discretisation, TheSurfaceRunsFromTheFrontPoleToTheRearPole) {
  // Its edges follow each other without gap, on the sphere, with falling x.
  for (const double ratio : {0.1, 0.5, 0.88}) {
    const SmallChannel channel(ratio);
    const auto& surface = channel.space.surface();
    const auto point = [&](int node) { return channel.space.node_points()[node]; };
    EXPECT_LT((point(surface.front().nodes.front()) - Point(ratio, 0)).norm(), rounding);
    EXPECT_LT((point(surface.back().nodes.back()) - Point(-ratio, 0)).norm(), rounding);
    for (std::size_t i = 0; i < surface.size(); ++i) {
      const auto& nodes = surface[i].nodes;
      EXPECT_EQ(nodes.front(), i > 0 ? surface[i - 1].nodes.back() : nodes.front());
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        EXPECT_NEAR(point(nodes[k]).norm(), ratio, rounding);
        EXPECT_TRUE(k == 0 || point(nodes[k])(0) < point(nodes[k - 1])(0));
      }
    }
  }
}

TEST(Discretisation, InletAndOutletSpanTheTube) {
  // Their edges lie at the ends and reach from axis to wall.
  const SmallChannel channel(0.5);
  const double end = channel.mesh.geometry().half_length();
  for (const auto& [edges, x] : {std::pair{&channel.space.inlet(), -end}, {&channel.space.outlet(), end}}) {
    double height = 0;
    for (const BoundaryEdge& edge : *edges) {
      const Point first = channel.space.node_points()[edge.nodes.front()];
      const Point last = channel.space.node_points()[edge.nodes.back()];
      EXPECT_NEAR(first(0), x, rounding);
      EXPECT_NEAR(last(0), x, rounding);
      height += last(1) - first(1);
    }
    EXPECT_NEAR(height, 1, rounding);
  }
}

TEST(Discretisation, EveryUnknownHasItsEquation) {
  // Rows of the elements name each unknown but the cell's velocity, whose equation is that of the barycentre.
  const SmallChannel channel(0.5);
  std::vector<int> owners(channel.space.unknowns(), 0);
  for (const ElementUnknowns& element : channel.space.elements()) {
    for (const int row : element.rows) {
      if (row >= 0) ++owners[row];
    }
  }
  for (int i = 0; i < channel.space.unknowns(); ++i) {
    EXPECT_EQ(owners[i] > 0, i != channel.space.cell_velocity()) << i;
  }
}

/// Current points of all nodes as each element sees them.
std::map<int, std::vector<Point>> current_points(const Discretisation& space, const VectorXd& state) {
  std::map<int, std::vector<Point>> seen;
  for (std::size_t e = 0; e < space.elements().size(); ++e) {
    const ElementUnknowns& element = space.elements()[e];
    const VectorXd local = local_values(element, state);
    const int m = element.position_columns;
    for (int k = 0; k < space.reference().nodes(); ++k) {
      const int node = space.nodes().of_element[e][k];
      Point x = space.node_points()[node];
      if (m > 0) {
        for (int c = 0; c < 2; ++c) x(c) += element.position->at_nodes[c].row(k) * local.segment(c * m, m);
      }
      seen[node].push_back(x);
    }
  }
  return seen;
}

TEST(Discretisation, TheMeshFollowsTheSurfaceWithoutGaps) {
  // Elements that share a node agree on where it goes, for any displacement; the box and the channel stay, but that
  // points of the wall above the cell slide along it.
  const SmallChannel channel(0.6, 5);
  const VectorXd state = 0.05 * test::random_vector(channel.space.unknowns());
  for (const auto& [node, points] : current_points(channel.space, state)) {
    for (const Point& x : points) EXPECT_LT((x - points[0]).norm(), rounding);
    const Point& X = channel.space.node_points()[node];
    const bool on_box = std::abs(X(0)) > channel.mesh.geometry().box() - 1e-9, on_wall = X(1) > 1 - 1e-9;
    EXPECT_TRUE(!on_box || (points[0] - X).norm() < rounding);
    EXPECT_TRUE(!on_wall || std::abs(points[0](1) - 1) < rounding);
    EXPECT_TRUE(X(1) > 1e-9 || points[0](1) < rounding) << "the axis stays the axis";
  }
}

TEST(Discretisation, ASteepWallThatPassesDoesNotFoldTheMesh) {
  // From 2 R to R within R, wherever it is. Spokes whose nodes all moved as far as the wall at their end folded there.
  const WallProfile wall({{0, 1}, {2, 1}});
  SmallChannel channel(0.55, 4, {}, {2, 4, 1, 2});
  Discretisation& space = channel.space;
  const VectorXd sphere = VectorXd::Zero(space.unknowns());
  for (double start = -6; start < 5; start += 0.25) {
    space.move_nodes(space.wall_motion([&](double x) { return wall.radius(x - start); }, sphere));
    for (const ElementUnknowns& element : space.elements())
      for (const PointMap<double, 2>& map : element.undeformed) EXPECT_GT(map.det, 0) << start;
  }
}

TEST(Discretisation, InletAndWallsMovePastTheCell) {
  // In the laboratory, v = w + v_cell is the undisturbed flow at the inlet and zero on the wall.
  const Liquid liquid{LiquidLaw::power_law, 0.6, 1e-3, 0};
  const SmallChannel channel(0.5, 4, liquid);
  VectorXd state = VectorXd::Zero(channel.space.unknowns());
  state(channel.space.cell_velocity()) = 1.3;
  const auto laboratory = [&](int node, int c) {
    const Slot& slot = channel.space.velocity(node, c);
    const double w = slot.constant + (slot.unknown >= 0 ? slot.factor * state(slot.unknown) : 0);
    return w + (c == 0 ? 1.3 : 0);
  };
  for (const BoundaryEdge& edge : channel.space.inlet()) {
    for (const int node : edge.nodes) {
      const double r = channel.space.node_points()[node](1);
      EXPECT_NEAR(laboratory(node, 0), undisturbed_velocity(liquid, r), rounding);
      EXPECT_EQ(laboratory(node, 1), 0);
    }
  }
  for (int node = 0; node < channel.space.nodes().count; ++node) {
    const bool on_wall = channel.space.node_points()[node](1) > 1 - 1e-12;
    EXPECT_TRUE(!on_wall || std::abs(laboratory(node, 0)) < rounding);
  }
}

}  // namespace
}  // namespace rheocyte::discretisation_test
