// Mesh, spaces and system of a small channel with a cell, and states to evaluate them at.
#pragma once
#include <random>

#include "fem/observe.h"
#include "fem/stationary_system.h"

namespace rheocyte::test {

struct SmallChannel {
  explicit SmallChannel(double radius_ratio, int degree = 4, const Liquid& liquid = {}, const Subdivision& n = {},
                        Interior interior = Interior::elastic)
      : mesh(ChannelGeometry(radius_ratio), n), space(mesh, degree, liquid, interior), system(space) {}
  ChannelMesh mesh;
  Discretisation space;
  StationarySystem system;
};

inline VectorXd random_vector(int size, unsigned seed = 1) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  return VectorXd::NullaryExpr(size, [&] { return normal(engine); });
}

/// The flow round the sphere, and the cell displaced by its linear response up to `displacement` of its radius.
inline VectorXd deformed_state(StationarySystem& system, const Media& media, double displacement = 0.1) {
  const Discretisation& space = system.space();
  const VectorXd sphere = system.sphere();
  const VectorXd residual = system.linearise(media, sphere).value;
  VectorXd state = sphere + system.solve(-residual);
  const double radius = space.mesh().geometry().radius();
  scale_displacement(space, displacement * radius / largest_displacement(space, state), state);
  return state;
}

/// Sets the pressure modes of one element to the projection of a function of (x, r).
template <class Function>
void set_pressure(const Discretisation& space, int e, const Function& p, VectorXd& state) {
  const ReferenceElement<2>& reference = space.reference();
  const auto& nodes = space.nodes().of_element[e];
  VectorXd values = VectorXd::Zero(reference.points());
  for (int q = 0; q < reference.points(); ++q) {
    Point x = Point::Zero();
    for (int k = 0; k < reference.nodes(); ++k) x += reference.shape.value(q, k) * space.node_points()[nodes[k]];
    values(q) = p(x(0), x(1));
  }
  const VectorXd modes = reference.pressure.value.transpose() * reference.weights.cwiseProduct(values);
  for (int k = 0; k < modes.size(); ++k) state(space.pressure(e, k)) = modes(k);
}

}  // namespace rheocyte::test
