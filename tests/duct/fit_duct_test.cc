#include "duct/fit_duct.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "duct/duct_system.h"
#include "duct/duct_transfer.h"
#include "duct/observe_duct.h"
#include "shape/measures.h"

namespace rheocyte::fit_duct_test {
namespace {

DuctSpace space_at(int degree, Symmetry symmetry, double offset = 0) {
  DuctShape shape{Section::square, 0.6};
  shape.offset = offset;
  return {DuctMesh(DuctGeometry(shape), {.along = 2, .layers = 2, .axial = 1}, symmetry), degree, Liquid{}};
}

/// The flow round a cell, which is displaced by its linear response up to so much of its radius.
VectorXd deformed(const DuctSpace& space, double displacement) {
  DuctSystem system(space);
  VectorXd state = system.sphere();
  const VectorXd residual = system.linearise({}, state).value;
  state += system.solve(-residual);
  system.scale_displacement(0.6 * displacement / system.largest_displacement(state), state);
  return state;
}

TEST(FitDuct, OnlyTheLiquidMoves) {
  // A cell displaced by 0.4 of its radius, in an eighth and a quarter of the duct, and off the axis in a half. The mesh
  // becomes better; nodes of the cell, of the ends, of walls and mirror planes stay where they have to.
  for (const auto& [symmetry, offset] :
       {std::pair{Symmetry::eighth, 0.0}, {Symmetry::quarter, 0.0}, {Symmetry::half, 0.1}}) {
    DuctSpace space = space_at(2, symmetry, offset);
    const VectorXd state = deformed(space, 0.4);
    const std::vector<DuctPoint> before = space.node_points(), after = fitted_points(space, state);
    const double quality = liquid_mesh_quality(space, state), end = space.mesh().geometry().end();
    space.set_points(after);
    EXPECT_GT(liquid_mesh_quality(space, state), 1.05 * quality);
    std::vector<bool> is_of_cell(before.size(), false);
    for (std::size_t e = 0; e < space.elements().size(); ++e) {
      for (const int node : space.nodes().of_element[e])
        if (!space.elements()[e].liquid) is_of_cell[node] = true;
    }
    for (std::size_t i = 0; i < before.size(); ++i) {
      const DuctPoint move = after[i] - before[i];
      if (is_of_cell[i] || std::abs(before[i](0)) > end - 1e-9) {
        EXPECT_EQ(move.norm(), 0);
      }
      for (int c = 1; c < 3; ++c) {
        if (std::abs(before[i](c)) > 1 - 1e-9) {
          EXPECT_NEAR(move(c), 0, 1e-12);
        }
      }
      const Across across = across_at(symmetry, before[i]);
      EXPECT_NEAR(across.holds_y ? move(1) : 0, 0, 1e-12);
      EXPECT_NEAR(across.holds_z ? move(2) : 0, 0, 1e-12);
      EXPECT_NEAR(across.ties ? move(1) - move(2) : 0, 0, 1e-12);
    }
  }
}

TEST(FitDuct, PointsAreTransferredToHigherDegrees) {
  // To the same degree exactly; at a higher one the same mesh is about as good.
  DuctSpace space = space_at(2, Symmetry::eighth), same = space_at(2, Symmetry::eighth),
            higher = space_at(3, Symmetry::eighth);
  const VectorXd state = deformed(space, 0.4);
  const std::vector<DuctPoint> points = fitted_points(space, state);
  space.set_points(points);
  const std::vector<DuctPoint> transferred = transferred_points(space, same);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT((transferred[i] - points[i]).norm(), 1e-12);
  higher.set_points(transferred_points(space, higher));
  EXPECT_NEAR(liquid_mesh_quality(higher, transfer(space, state, higher)), liquid_mesh_quality(space, state), 0.05);
}

TEST(FitDuct, FieldsAreTransferredToOtherElements) {
  // To a mesh with another number of elements, cut elsewhere along the side, in the ring and in the liquid: what
  // differs are polynomials of the same degree.
  const DuctSpace space = space_at(5, Symmetry::eighth);
  const DuctSubdivision other{.along = 3, .layers = 3, .ring = 2, .axial = 1};
  const DuctSpace elsewhere(DuctMesh(space.mesh().geometry(), other, Symmetry::eighth, {-1, -0.7, 0.2, 1}), 5,
                            Liquid{});
  const VectorXd state = deformed(space, 0.2), there = transfer(space, state, elsewhere);
  const double deformation = measure(duct_contour(space, state, Camera::side)).deformation;
  EXPECT_NEAR(measure(duct_contour(elsewhere, there, Camera::side)).deformation, deformation, 2e-3 * deformation);
  EXPECT_EQ(there(elsewhere.cell_velocity()), state(space.cell_velocity()));
  DuctSystem system(space), system_elsewhere(elsewhere);
  const double at_rest = system_elsewhere.residual({}, system_elsewhere.sphere()).value.norm();
  EXPECT_LT(system_elsewhere.residual({}, there).value.norm(), 0.2 * at_rest);
}

TEST(FitDuct, ElementsAlongTheSideBecomeEven) {
  const DuctSpace space = space_at(3, Symmetry::eighth);
  const VectorXd state = deformed(space, 0.6);
  const std::vector<double> as_they_are = fitted_breaks(space, state, 0), even = fitted_breaks(space, state, 1);
  for (std::size_t i = 0; i < even.size(); ++i) EXPECT_NEAR(as_they_are[i], space.mesh().side_breaks()[i], 1e-12);
  EXPECT_TRUE(std::ranges::is_sorted(even));
  const DuctSpace cut(DuctMesh(space.mesh().geometry(), space.mesh().subdivision(), Symmetry::eighth, even), 3,
                      Liquid{});
  EXPECT_GT(surface_evenness(cut, transfer(space, state, cut)), surface_evenness(space, state));
  EXPECT_GT(surface_evenness(cut, transfer(space, state, cut)), 0.9);
}

}  // namespace
}  // namespace rheocyte::fit_duct_test
