#include "fem/outlet_load.h"

namespace rheocyte {

VectorXd outlet_load(const Discretisation& space, const Liquid& liquid) {
  VectorXd residual = VectorXd::Zero(space.unknowns());
  const ReferenceElement& reference = space.reference();
  const double pressure = -undisturbed_pressure_gradient(liquid) * space.mesh().geometry().half_length();
  const MatrixXd value = reference.lagrange(reference.points_1d);
  for (const BoundaryEdge& edge : space.outlet()) {
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
  return residual;
}

}  // namespace rheocyte
