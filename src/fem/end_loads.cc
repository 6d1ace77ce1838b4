#include "fem/end_loads.h"

#include "laws/developed_flow.h"

namespace rheocyte {
namespace {

/// Adds `pressure` times the area of each axial test function on the edges, per radian.
void add_pressure(const Discretisation& space, const std::vector<BoundaryEdge>& edges, double pressure,
                  VectorXd& residual) {
  const ReferenceElement<2>& reference = space.reference();
  const MatrixXd value = reference.lagrange(reference.points_1d);
  for (const BoundaryEdge& edge : edges) {
    VectorXd r(edge.nodes.size());
    for (int k = 0; k < r.size(); ++k) r(k) = space.node_points()[edge.nodes[k]](1);
    const double width = r.maxCoeff() - r.minCoeff();
    const VectorXd load = value.transpose() * (reference.weights_1d.array() * (value * r).array()).matrix();
    for (int k = 0; k < r.size(); ++k) {
      const Slot& slot = space.velocity(edge.nodes[k], 0);
      if (slot.unknown >= 0 && slot.unknown != space.cell_velocity()) {
        residual(slot.unknown) += pressure * width * load(k);
      }
    }
  }
}

}  // namespace

VectorXd outlet_load(const Discretisation& space) {
  VectorXd residual = VectorXd::Zero(space.unknowns());
  add_pressure(space, space.outlet(), 1, residual);
  return residual;
}

VectorXd inlet_load(const Discretisation& space) {
  VectorXd residual = VectorXd::Zero(space.unknowns());
  if (space.has_open_inlet()) add_pressure(space, space.inlet(), -1, residual);
  return residual;
}

double undisturbed_inlet_pressure(const Discretisation& space, const Liquid& liquid) {
  return undisturbed_pressure_gradient(liquid) * space.mesh().geometry().end();
}

}  // namespace rheocyte
