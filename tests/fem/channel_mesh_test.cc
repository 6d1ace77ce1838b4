#include "fem/channel_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "fem/discretisation.h"

namespace rheocyte::channel_mesh_test {
namespace {

constexpr std::array radius_ratios = {0.05, 0.1, 0.3, 0.5, 0.7, 0.88, 0.965};
constexpr std::array spacings = {Spacing::even, Spacing::by_shear};
const std::array<Subdivision, 3> subdivisions = {{{2, 4, 1, 2}, {3, 6, 1, 2}, {4, 8, 2, 2}}};

/// det d(x, r)/d(xi) of the geometry itself by central differences.
double det(const ChannelGeometry& geometry, const MeshElement& element, double xi1, double xi2) {
  constexpr double h = 1e-6;
  const Point x1 = (element.map(geometry, xi1 + h, xi2) - element.map(geometry, xi1 - h, xi2)) / (2 * h);
  const Point x2 = (element.map(geometry, xi1, xi2 + h) - element.map(geometry, xi1, xi2 - h)) / (2 * h);
  return x1(0) * x2(1) - x1(1) * x2(0);
}

TEST(ChannelMesh, EveryElementIsRightHanded) {
  // det > 0 everywhere inside, for each cell size from a twentieth of the tube to 95 %.
  for (const double ratio : radius_ratios) {
    for (const Subdivision& n : subdivisions) {
      for (const Spacing spacing : spacings) {
        const ChannelMesh mesh(ChannelGeometry(ratio), n, spacing);
        for (const MeshElement& element : mesh.elements()) {
          for (int i = 0; i < 36; ++i) {
            EXPECT_GT(det(mesh.geometry(), element, 0.01 + 0.196 * (i % 6), 0.01 + 0.196 * (i / 6)), 0) << ratio;
          }
        }
      }
    }
  }
}

TEST(ChannelMesh, TheInterpolatedElementsAreRightHandedToo) {
  // The elements that the integrals see are polynomial images of the blocks.
  for (const double ratio : radius_ratios) {
    for (const int degree : {4, 8}) {
      for (const Spacing spacing : spacings) {
        const ChannelMesh mesh(ChannelGeometry(ratio), subdivisions[0], spacing);
        const Discretisation space(mesh, degree, {});
        for (const ElementUnknowns& element : space.elements()) {
          for (const PointMap<double, 2>& map : element.undeformed) EXPECT_GT(map.det, 0) << ratio;
        }
      }
    }
  }
}

TEST(ChannelMesh, TheElementsFillCellAndChannel) {
  // Integrals of 1 and of r: half-plane and body of channel and cell have their areas and volumes.
  constexpr double ratio = 0.6;
  const ChannelMesh mesh(ChannelGeometry(ratio), subdivisions[1]);
  const Discretisation space(mesh, 10, {});
  double area = 0, volume = 0, cell_volume = 0;
  for (const ElementUnknowns& element : space.elements()) {
    for (int q = 0; q < space.reference().points(); ++q) {
      const PointMap<double, 2>& map = element.undeformed[q];
      area += space.reference().weights(q) * map.det;
      volume += space.reference().weights(q) * map.volume();
      if (!element.liquid) cell_volume += space.reference().weights(q) * map.volume();
    }
  }
  const double length = 2 * mesh.geometry().half_length();
  // Axis, wall and ends are straight: area and volume are exact. The circle is interpolated by pieces of 30 degrees
  // and degree 10: below rounding.
  EXPECT_NEAR(area, length, 1e-12);
  EXPECT_NEAR(volume, length / 2, 1e-12);
  EXPECT_NEAR(cell_volume, 2.0 / 3 * std::pow(ratio, 3), 1e-12);
}

TEST(ChannelMesh, NodesAreSharedByTheElementsThatTouch) {
  // Two elements use the same number exactly where they mean the same point.
  for (const double ratio : {0.05, 0.6, 0.965}) {
    const ChannelMesh mesh(ChannelGeometry(ratio), subdivisions[0]);
    const Discretisation space(mesh, 5, {});
    const VectorXd& s = space.reference().nodes_1d;
    for (std::size_t e = 0; e < mesh.elements().size(); ++e) {
      for (int k = 0; k < space.reference().nodes(); ++k) {
        const Point x = mesh.elements()[e].map(mesh.geometry(), s(k % 6), s(k / 6));
        EXPECT_LT((space.node_points()[space.nodes().of_element[e][k]] - x).norm(), 1e-14);  // rounding
      }
    }
    std::set<std::pair<long, long>> distinct;
    for (const Point& x : space.node_points()) distinct.insert({std::lround(x(0) * 1e9), std::lround(x(1) * 1e9)});
    EXPECT_EQ(int(distinct.size()), space.nodes().count);
  }
}

TEST(ChannelMesh, TheFirstLayerOfLiquidIsAboutAsHighAsWideAtMost) {
  // Higher elements on the surface lose stability against short waves before the solid does.
  for (const double ratio : {0.1, 0.3, 0.5, 0.7, 0.88}) {
    const ChannelMesh mesh(ChannelGeometry(ratio), subdivisions[0]);
    for (const MeshElement& element : mesh.elements()) {
      if (!has_spokes(element.block) || element.outward[0] > 0) continue;
      const auto corner = [&](double outward, double along) {
        return mesh.geometry().map(element.block, outward, along);
      };
      const auto [a, b] = element.along;
      const double width = (corner(0, b) - corner(0, a)).norm();
      const double height = (corner(element.outward[1], a) - corner(0, a)).norm();
      // The spokes to the box's corners are the longest, and the number of layers is rounded: some ten per cent.
      EXPECT_LT(height, 1.1 * width) << ratio;
    }
  }
}

TEST(ChannelMesh, ThePlacesOfItsEdgesOnTheSurfaceAreThoseOfTheSurfacesNodes) {
  constexpr double ratio = 0.6;
  for (const Spacing spacing : spacings) {
    const ChannelMesh mesh(ChannelGeometry(ratio), subdivisions[1], spacing);
    const Discretisation space(mesh, 4, {});
    const std::vector<double> places = mesh.surface_places();
    ASSERT_EQ(places.size(), space.surface().size() + 1);
    for (std::size_t i = 0; i < space.surface().size(); ++i) {
      const auto angle_of = [&](int node) {
        return std::atan2(space.node_points()[node](1), space.node_points()[node](0));
      };
      // A place is four times the angle over pi, in each sector.
      EXPECT_NEAR(angle_of(space.surface()[i].nodes.front()), places[i] * std::numbers::pi / 4, 1e-12);
      EXPECT_NEAR(angle_of(space.surface()[i].nodes.back()), places[i + 1] * std::numbers::pi / 4, 1e-12);
    }
  }
}

TEST(ChannelMesh, ByShearTheElementsAreShortWhereTheRingIs) {
  const Subdivision& n = subdivisions[0];
  const ChannelGeometry geometry(0.6);
  EXPECT_EQ(ChannelMesh(geometry, n).surface_places(), (std::vector<double>{0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4}));
  const std::vector<double> places = ChannelMesh(geometry, n, Spacing::by_shear).surface_places();
  ASSERT_EQ(places.size(), 13u);
  for (std::size_t i = 1; i < places.size(); ++i) {
    EXPECT_GT(places[i], places[i - 1]);
    const bool is_in_ring = places[i - 1] > 2.39 && places[i] <= 3;
    EXPECT_LT(places[i] - places[i - 1], is_in_ring ? 0.13 : 0.66);
  }
  // The rear is the front's mirror image: the core has the same breaks on both sides.
  for (int i = 0; i <= n.front; ++i) EXPECT_NEAR(places[i] + places[places.size() - 1 - i], 4, 1e-15);
}

}  // namespace
}  // namespace rheocyte::channel_mesh_test
