#include "fem/nodal_fields.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "fem/observe.h"

namespace rheocyte {

namespace {

/// A liquid interior has no displacement of its own: for the eye it follows the surface along spokes from the centre.
/// Nodes x 2.
Eigen::MatrixX2d spoke_displacement(const Discretisation& space, const VectorXd& unknowns, int e) {
  const SurfaceState surface = surface_state(space, unknowns, 65);
  const double radius = space.mesh().geometry().radius();
  const auto& nodes = space.nodes().of_element[e];
  Eigen::MatrixX2d displacement(nodes.size(), 2);
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
    const double share = gap > 0 ? std::clamp((angle - surface.angle(i - 1)) / gap, 0.0, 1.0) : 0;
    const Point foot = (1 - share) * surface.point.row(i - 1) + share * surface.point.row(i);
    displacement.row(k) = (X.norm() / radius * foot - X).transpose();
  }
  return displacement;
}

}  // namespace

double von_mises(Tensor<double> sigma) {
  const double mean = sigma.trace() / 3;
  for (int i = 0; i < 3; ++i) sigma(i, i) -= mean;
  return std::sqrt(1.5) * sigma.norm();
}

double max_stretch(const Tensor<double>& F) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> squares;
  squares.computeDirect((F.transpose() * F).eigen(), Eigen::EigenvaluesOnly);
  return std::sqrt(squares.eigenvalues()(2));
}

double shear_rate(const Tensor<double>& L) { return (L + L.transpose()).norm() / std::sqrt(2.0); }

NodalFields::NodalFields(const Discretisation& space, const Media& media, const VectorXd& unknowns,
                         const Scales& scales)
    : space_(space),
      media_(media),
      unknowns_(unknowns),
      scales_(scales),
      to_nodes_(space.reference().points_to_nodes()) {}

VectorXd NodalFields::at_nodes(const VectorXd& at_points) const {
  const Eigen::Index m = to_nodes_.cols();
  const MatrixXd nodal = to_nodes_ * at_points.reshaped(m, m) * to_nodes_.transpose();
  return nodal.reshaped();
}

void NodalFields::add_liquid_stress(int e, MatrixXd& fields) const {
  VectorXd norm(space_.reference().points()), rates(norm.size());
  int q = 0;
  for (const auto& f : fields_at_points<LiquidFields<double, 2>>(space_, e, unknowns_)) {
    const Tensor<double> L = gradient(PointMap<double, 2>(f.map), f.w, f.w_xi);
    norm(q) = viscous_stress(media_.liquid, L).norm() / std::sqrt(2.0);
    rates(q++) = rheocyte::shear_rate(L);
  }
  fields.col(shear_stress) = scales_.stress_Pa * at_nodes(norm);
  fields.col(rate) = at_nodes(rates) / scales_.time_s();
}

void NodalFields::add_cell_stress(int e, MatrixXd& fields) const {
  const ElementUnknowns& element = space_.elements()[e];
  VectorXd norm(space_.reference().points()), stretches(norm.size());
  int q = 0;
  for (const auto& f : fields_at_points<MapFields<double, 2>>(space_, e, unknowns_)) {
    const Tensor<double> F = deformation_gradient(PointMap<double, 2>(f), element.undeformed[q]);
    norm(q) = von_mises(elastic_stress(media_.bulk, F));
    stretches(q++) = max_stretch(F);
  }
  fields.col(stress) = scales_.stress_Pa * at_nodes(norm);
  fields.col(stretch) = at_nodes(stretches);
}

MatrixXd NodalFields::in_liquid_interior(int e) const {
  const auto& nodes = space_.nodes().of_element[e];
  const double um = scales_.length_um();
  const double at_rest = rest_pressure(media_.cortex, space_.mesh().geometry().radius());
  MatrixXd fields = MatrixXd::Zero(Eigen::Index(nodes.size()), columns);
  fields.col(region).setOnes();
  fields.middleCols(ux, 2) = um * spoke_displacement(space_, unknowns_, e);
  for (int k = 0; k < int(nodes.size()); ++k) {
    for (int c = 0; c < 2; ++c) fields(k, x + c) = um * space_.node_points()[nodes[k]](c) + fields(k, ux + c);
  }
  fields.col(vx).setConstant(scales_.velocity_m_per_s * unknowns_(space_.cell_velocity()));
  fields.col(pressure).setConstant(scales_.stress_Pa * (at_rest + unknowns_(space_.inner_pressure())));
  return fields;
}

MatrixXd NodalFields::of_element(int e) const {
  const ElementUnknowns& element = space_.elements()[e];
  if (element.is_empty()) return in_liquid_interior(e);
  const auto& nodes = space_.nodes().of_element[e];
  const int n = int(nodes.size()), m = element.position_columns;
  const VectorXd local = local_values(element, unknowns_);
  const double um = scales_.length_um(), v_cell = unknowns_(space_.cell_velocity());
  const double at_rest = rest_pressure(media_.cortex, space_.mesh().geometry().radius());

  MatrixXd fields = MatrixXd::Zero(n, columns);
  fields.col(region).setConstant(element.liquid ? 0 : 1);
  for (int c = 0; c < 2; ++c) {
    if (m > 0) fields.col(ux + c) = um * (element.position->at_nodes[c] * local.segment(c * m, m));
    for (int k = 0; k < n; ++k) fields(k, x + c) = um * space_.node_points()[nodes[k]](c) + fields(k, ux + c);
    if (element.liquid) fields.col(wx + c) = scales_.velocity_m_per_s * local.segment(2 * m + c * n, n);
  }
  fields.col(vx) = fields.col(wx).array() + scales_.velocity_m_per_s * v_cell;
  fields.col(vr) = fields.col(wr);
  const VectorXd p = space_.reference().pressure.value * local.tail(space_.reference().pressures());
  fields.col(pressure) = scales_.stress_Pa * (at_nodes(p).array() + (element.liquid ? 0 : at_rest));
  element.liquid ? add_liquid_stress(e, fields) : add_cell_stress(e, fields);
  return fields;
}

}  // namespace rheocyte
