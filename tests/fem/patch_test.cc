// States that satisfy the equations exactly have to leave no residual.
#include <gtest/gtest.h>

#include "small_channel.h"

namespace rheocyte::patch_test {
namespace {

using test::SmallChannel;

/// Sets the velocity at the liquid's free nodes to v(x, r) - (v_cell, 0).
template <class Velocity>
void set_velocity(const Discretisation& space, const Velocity& v, VectorXd& state) {
  const double v_cell = state(space.cell_velocity());
  for (int node = 0; node < space.nodes().count; ++node) {
    const Point x = space.node_points()[node];
    const Point w = v(x(0), x(1)) - Point(v_cell, 0);
    for (int c = 0; c < 2; ++c) {
      const int unknown = space.velocity(node, c).unknown;
      if (unknown >= 0 && unknown != space.cell_velocity()) state(unknown) = w(c);
    }
  }
}

/// Largest residual among the equations of the liquid's nodes and of its elements where `where(x, r)` holds.
template <class Where>
double largest_residual(const Discretisation& space, const VectorXd& residual, const Where& where) {
  double largest = 0;
  const auto take = [&](int unknown) {
    if (unknown >= 0 && unknown != space.cell_velocity()) largest = std::max(largest, std::abs(residual(unknown)));
  };
  for (std::size_t e = 0; e < space.elements().size(); ++e) {
    bool whole = true;
    for (const int node : space.nodes().of_element[e]) {
      const Point x = space.node_points()[node];
      const bool here = where(x(0), x(1));
      whole = whole && here;
      if (!here) continue;
      for (int c = 0; c < 2; ++c) {
        take(space.velocity(node, c).unknown);
        take(space.displacement(node, c));
      }
    }
    if (!whole || !space.elements()[e].liquid) continue;
    for (int k = 0; k < space.reference().pressures(); ++k) take(space.pressure(int(e), k));
  }
  return largest;
}

TEST(Patch, PoiseuilleFlowIsExactInTheStraightChannel) {
  // u = 2 (1 - r^2), p = -8 x up- and downstream of the box, seen from a cell of any speed, inertia or not: the
  // quadratic velocity lies in the space, and inlet and outlet carry the right data.
  for (const double reynolds : {0.0, 0.7}) {
    for (const int degree : {2, 4, 7}) {
      const Media media{{LiquidLaw::newtonian, 1, 0, reynolds}, {BulkLaw::neo_hookean, 10}};
      SmallChannel channel(0.5, degree, media.liquid);
      VectorXd state = channel.system.sphere();
      state(channel.space.cell_velocity()) = 1.3;
      set_velocity(
          channel.space, [](double, double r) { return Point(2 * (1 - r * r), 0); }, state);
      for (int e = 0; e < int(channel.space.elements().size()); ++e) {
        test::set_pressure(
            channel.space, e, [](double x, double) { return -8 * x; }, state);
      }
      const VectorXd residual = channel.system.residual(media, state).value;
      const double box = channel.mesh.geometry().box();
      const auto straight = [box](double x, double) { return std::abs(x) > box + 1e-9; };
      // Rounding of pressures up to 28.
      EXPECT_LT(largest_residual(channel.space, residual, straight), 1e-11) << degree;
      EXPECT_GT(residual.norm(), 0.1) << "the cell is in the way";
    }
  }
}

TEST(Patch, ALinearFlowAndItsPressureAreExactInCurvedElements) {
  // v = (x, -r/2) with constant pressure has the constant stress 2 D - p I: interior equations vanish between the
  // cell and the channel, where the elements are curved; degree 4 integrates them exactly.
  const Media media{{}, {BulkLaw::neo_hookean, 10}};
  SmallChannel channel(0.5, 4, media.liquid);
  VectorXd state = VectorXd::Zero(channel.space.unknowns());
  set_velocity(
      channel.space, [](double x, double r) { return Point(x, -0.5 * r); }, state);
  for (int e = 0; e < int(channel.space.elements().size()); ++e) {
    test::set_pressure(
        channel.space, e, [](double, double) { return 0.7; }, state);
  }
  const VectorXd residual = channel.system.residual(media, state).value;
  // Elements on the surface or the wall see the no-slip condition there.
  for (std::size_t e = 0; e < channel.mesh.elements().size(); ++e) {
    const MeshElement& element = channel.mesh.elements()[e];
    if (!has_spokes(element.block) || element.outward[0] == 0 || element.outward[1] == 1) continue;
    for (int k = 0; k < channel.space.reference().nodes(); ++k) {
      if (!channel.space.reference().is_interior(k)) continue;
      const int node = channel.space.nodes().of_element[e][k];
      // Rounding of stresses of order one.
      for (int c = 0; c < 2; ++c) EXPECT_NEAR(residual(channel.space.velocity(node, c).unknown), 0, 1e-13);
    }
  }
}

TEST(Patch, AUniformPressureIsInEquilibriumWithAnyShape) {
  // Liquid at rest and a cell without stiffness under one pressure: forces on the surface cancel to rounding in any
  // deformed state, since degree 4 integrates r cof(grad x) exactly.
  const Media media{{}, {BulkLaw::neo_hookean, 0}};
  SmallChannel channel(0.6, 4);
  VectorXd state = 0.01 * test::random_vector(channel.space.unknowns());
  set_velocity(
      channel.space, [&](double, double) { return Point(state(channel.space.cell_velocity()), 0); }, state);
  state(channel.space.cell_velocity()) = 0;
  for (int e = 0; e < int(channel.space.elements().size()); ++e) {
    test::set_pressure(
        channel.space, e, [](double, double) { return 1; }, state);
  }
  const VectorXd residual = channel.system.residual(media, state).value;
  const double box = channel.mesh.geometry().box();
  for (int node = 0; node < channel.space.nodes().count; ++node) {
    if (std::abs(channel.space.node_points()[node](0)) > box + 1e-9) continue;
    for (int c = 0; c < 2; ++c) {
      for (const int unknown : {channel.space.displacement(node, c), channel.space.velocity(node, c).unknown}) {
        if (unknown < 0 || unknown == channel.space.cell_velocity()) continue;
        EXPECT_NEAR(residual(unknown), 0, 1e-14);  // rounding of a pressure of one on elements of a tenth
      }
    }
  }
}

TEST(Patch, TheUndeformedCellHasItsBarycentreAtTheOrigin) {
  // The equation of the cell's velocity measures the first moment; a shift by s gives s V / (2 pi).
  SmallChannel channel(0.6, 8);
  VectorXd state = channel.system.sphere();
  const int row = channel.space.cell_velocity();
  EXPECT_NEAR(channel.system.residual({}, state).value(row), 0, 1e-15);  // rounding
  constexpr double shift = 0.02;
  for (int node = 0; node < channel.space.nodes().count; ++node) {
    if (const int x = channel.space.displacement(node, 0); x >= 0) state(x) = shift;
  }
  // Degree 8 interpolates the volume of the sphere to 1e-10.
  EXPECT_NEAR(channel.system.residual({}, state).value(row) / (shift * 2.0 / 3 * std::pow(0.6, 3)), 1, 1e-9);
}

}  // namespace
}  // namespace rheocyte::patch_test
