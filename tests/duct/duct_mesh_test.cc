#include "duct/duct_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fem/reference_element.h"
#include "laws/cartesian.h"

namespace rheocyte::duct_mesh_test {
namespace {

/// Volumes of the cell and of everything, by the quadrature of elements of some degree; and the least det of a map.
struct Volumes {
  double cell = 0, all = 0, min_det = 1e300;
};

Volumes volumes(const DuctMesh& mesh, int degree) {
  const ReferenceElement<3> reference(degree);
  const int n = degree + 1;
  Volumes sum;
  for (int e = 0; e < int(mesh.elements().size()); ++e) {
    Eigen::MatrixX3d X(reference.nodes(), 3);
    for (int k = 0; k < reference.nodes(); ++k) {
      X.row(k) =
          mesh.point(e, {reference.nodes_1d(k % n), reference.nodes_1d(k / n % n), reference.nodes_1d(k / (n * n))});
    }
    std::array<Eigen::MatrixX3d, 3> G;
    for (int k = 0; k < 3; ++k) G[k] = reference.shape.slope[k] * X;
    for (int q = 0; q < reference.points(); ++q) {
      MapFields<double, 3> map;
      for (int i = 0; i < 9; ++i) map.G(i) = G[i / 3](q, i % 3);
      const double det = PointMap<double, 3>(map).det;
      sum.min_det = std::min(sum.min_det, det);
      (mesh.elements()[e].in_cell() ? sum.cell : sum.all) += reference.weights(q) * det;
    }
  }
  sum.all += sum.cell;
  return sum;
}

TEST(DuctMesh, AnEighthOfCellAndDuctIsFilledWithoutFolds) {
  constexpr double pi = std::numbers::pi;
  for (const Section section : {Section::square, Section::tube}) {
    for (const double a : {0.1, 0.35, 0.6, 0.86, 0.93}) {
      const DuctGeometry geometry(section, a);
      const Volumes v = volumes(DuctMesh(geometry, {}), 5);
      // Polynomials of degree 5 against the circles of coarse elements.
      EXPECT_NEAR(v.cell / (pi * a * a * a / 6), 1, 1e-5) << a;
      const double area = section == Section::square ? 0.5 : pi / 8;
      EXPECT_NEAR(v.all / (2 * geometry.half_length() * area), 1, 1e-5) << a;
      EXPECT_GT(v.min_det, 0) << a;
    }
  }
}

TEST(DuctMesh, PartsOfARectangleAreFilledWithoutFolds) {
  constexpr double pi = std::numbers::pi;
  for (const Extent& extent : {Extent{1, 1}, Extent{2, 1}, Extent{1, 4}}) {
    for (const Symmetry symmetry : {Symmetry::quarter, Symmetry::half}) {
      const DuctGeometry geometry({Section::rectangle, 0.7, extent});
      const Volumes v = volumes(DuctMesh(geometry, {}, symmetry), 5);
      const double fraction = 1.0 / double(copies_of(symmetry).size());
      EXPECT_NEAR(v.cell / (fraction * 4 * pi / 3 * 0.343), 1, 1e-5);
      EXPECT_NEAR(v.all / (fraction * 2 * geometry.half_length() * geometry.area()), 1, 1e-5);
      EXPECT_GT(v.min_det, 0);
    }
  }
}

TEST(DuctMesh, ALongDuctEndsWithOneElementMore) {
  const DuctGeometry shortest(Section::square, 0.5), longer({.radius = 0.5, .length = 20});
  EXPECT_EQ(longer.half_length(), 10);
  EXPECT_EQ(DuctMesh(longer, {}).elements().size(), DuctMesh(shortest, {}).elements().size() + 2 * 3);
  EXPECT_NEAR(volumes(DuctMesh(longer, {}), 4).all, 10, 1e-4);
}

TEST(DuctMesh, ItGoesOnBeyondTheDuctThatIsToldOf) {
  // By the run-out, with a plane between elements where the reported duct ends.
  const DuctGeometry geometry({.radius = 0.5, .length = 14, .run_out = 2.5});
  EXPECT_EQ(geometry.half_length(), 7);
  EXPECT_EQ(geometry.end(), 9.5);
  const DuctMesh mesh(geometry, {}, Symmetry::quarter);
  EXPECT_NEAR(volumes(mesh, 4).all, 9.5 * 2, 1e-4);
  for (const double outward : {1.0, 2.0}) {
    const double x = outward == 1 ? 7 : 9.5;
    for (const double sign : {1.0, -1.0}) EXPECT_EQ(geometry.map(Part::end, {sign, 0.3, 0.6}, outward)(0), sign * x);
  }
  const auto ends_at_plane = [](const DuctElement& e) {
    return e.part == Part::end && std::abs(e.outward[1] - 1) < 1e-12;
  };
  EXPECT_EQ(std::ranges::count_if(mesh.elements(), ends_at_plane), 2 * 6);
}

TEST(DuctMesh, NeighboursShareTheirNodes) {
  // Euler's count of the mesh of 57 hexahedra at degree 1: vertices of the cell, the liquid and the ends.
  const DuctMesh mesh(DuctGeometry(Section::square, 0.6), {.along = 3, .layers = 2, .axial = 2});
  ASSERT_EQ(mesh.elements().size(), 57u);
  const NodeNumbers numbers = mesh.number_nodes(1);
  // Seven per triangle of three quadrilaterals: 4 levels of the core; 3 levels of a closed surface of 2 x 7 and
  // 2 rows of 3 vertices; 2 ends of 2 further levels.
  EXPECT_EQ(numbers.count, 4 * 7 + 3 * (2 * 7 + 2 * 3) + 2 * 2 * 7);
}

TEST(DuctMesh, FirstLayerIsHalfAsHighAsTheSurfacesElementsAreWide) {
  EXPECT_EQ(duct_layers_for(DuctGeometry(Section::square, 0.6), {}), 3);
  EXPECT_GE(duct_layers_for(DuctGeometry(Section::square, 0.3), {}), 4);
}

}  // namespace
}  // namespace rheocyte::duct_mesh_test
