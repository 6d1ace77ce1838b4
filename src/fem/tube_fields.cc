#include "fem/tube_fields.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fem/observe.h"
#include "fem/sample_fields.h"

namespace rheocyte {
namespace {

/// A liquid interior has no displacement of its own: for the eye it follows the surface along spokes from the centre.
/// Nodes x 2.
MatrixXd spoke_displacement(const Discretisation& space, const VectorXd& unknowns, int e) {
  const SurfaceState surface = surface_state(space, unknowns, 65);
  const double radius = space.mesh().geometry().radius();
  const auto& nodes = space.nodes().of_element[e];
  MatrixXd displacement(nodes.size(), 2);
  for (int k = 0; k < int(nodes.size()); ++k) {
    const Point& X = space.node_points()[nodes[k]];
    if (space.displacement(nodes[k], 0) >= 0) {
      displacement.row(k) = (current_point(space, unknowns, nodes[k]) - X).transpose();
      continue;
    }
    const double angle = std::atan2(X(1), X(0));
    const double* begin = surface.angle.data();
    const Eigen::Index i = std::clamp<Eigen::Index>(
        std::upper_bound(begin, begin + surface.angle.size(), angle) - begin, 1, surface.angle.size() - 1);
    const double gap = surface.angle(i) - surface.angle(i - 1);
    const double fraction = gap > 0 ? std::clamp((angle - surface.angle(i - 1)) / gap, 0.0, 1.0) : 0;
    const Point foot = (1 - fraction) * surface.point.row(i - 1) + fraction * surface.point.row(i);
    displacement.row(k) = (X.norm() / radius * foot - X).transpose();
  }
  return displacement;
}

}  // namespace

ElementState TubeFields::state_of(int e) const {
  const ElementUnknowns& element = space_.elements()[e];
  const auto& nodes = space_.nodes().of_element[e];
  const int n = int(nodes.size()), m = element.position_columns;
  ElementState state{element.liquid, MatrixXd(n, 2), MatrixXd::Zero(n, 2), MatrixXd::Zero(n, 2), {}, {}};
  for (int k = 0; k < n; ++k) state.rest.row(k) = space_.node_points()[nodes[k]].transpose();
  if (element.is_empty()) {
    state.displacement = spoke_displacement(space_, unknowns_, e);
    state.pressure.setConstant(n, unknowns_(space_.inner_pressure()));
    return state;
  }
  const VectorXd local = local_values(element, unknowns_);
  for (int c = 0; c < 2; ++c) {
    if (m > 0) state.displacement.col(c) = element.position->at_nodes[c] * local.segment(c * m, m);
    if (element.liquid) state.velocity.col(c) = local.segment(2 * m + c * n, n);
  }
  state.pressure = at_nodes(space_.reference().pressure.value * local.tail(space_.reference().pressures()));
  if (element.liquid) {
    for (const auto& f : fields_at_points<LiquidFields<double, 2>>(space_, e, unknowns_))
      state.gradients.push_back(gradient(PointMap<double, 2>(f.map), f.w, f.w_xi));
  } else {
    std::size_t q = 0;
    for (const auto& f : fields_at_points<MapFields<double, 2>>(space_, e, unknowns_))
      state.gradients.push_back(deformation_gradient(PointMap<double, 2>(f), element.undeformed[q++]));
  }
  return state;
}

SampledFields sample_fields(const TubeFields& fields, int points) {
  std::vector<int> nodes((fields.degree() + 1) * (fields.degree() + 1));
  std::iota(nodes.begin(), nodes.end(), 0);
  std::vector<FaceInPlane> all;
  for (int e = 0; e < fields.elements(); ++e) all.push_back({e, nodes});
  return sample_faces(fields, all, VectorXd::Ones(1), points);
}

}  // namespace rheocyte
