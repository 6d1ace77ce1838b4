#include "duct/fit_duct.h"

#include <gtest/gtest.h>

#include "duct/duct_system.h"
#include "duct/observe_duct.h"

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

}  // namespace
}  // namespace rheocyte::fit_duct_test
