#include "fem/write_fields.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "fem/observe.h"
#include "fem/vtu_file.h"

namespace rheocyte {
namespace {

/// Columns of the nodal fields, physical units.
enum Field { x, r, vx, vr, wx, wr, pressure, stress, shear_stress, ux, ur, region, field_count };

double von_mises(Tensor<double> sigma) {
  const double mean = sigma.trace() / 3;
  for (int i = 0; i < 3; ++i) sigma(i, i) -= mean;
  return std::sqrt(1.5) * sigma.norm();
}

/// Norm of the liquid's viscous stress, or of the cell's elastic stress, at the quadrature points of an element.
VectorXd stress_at_points(const Discretisation& space, int e, const Media& media, const VectorXd& unknowns) {
  const ElementUnknowns& element = space.elements()[e];
  VectorXd norm(space.reference().points());
  int q = 0;
  if (element.liquid) {
    for (const auto& f : fields_at_points<LiquidFields<double, 2>>(space, e, unknowns)) {
      const Tensor<double> L = gradient(PointMap<double, 2>(f.map), f.w, f.w_xi);
      norm(q++) = viscous_stress(media.liquid, L).norm() / std::sqrt(2.0);
    }
  } else {
    for (const auto& f : fields_at_points<MapFields<double, 2>>(space, e, unknowns)) {
      const Tensor<double> F = deformation_gradient(PointMap<double, 2>(f), element.undeformed[q]);
      norm(q++) = von_mises(elastic_stress(media.bulk, F));
    }
  }
  return norm;
}

/// Carries values at the quadrature points to the nodes: the Q_p function that fits them best.
class ToNodes {
 public:
  explicit ToNodes(const ReferenceElement<2>& reference)
      : shape_(reference.shape.value),
        weights_(reference.weights),
        mass_(shape_.transpose() * weights_.asDiagonal() * shape_) {}
  VectorXd operator()(const VectorXd& at_points) const {
    return mass_.solve(shape_.transpose() * weights_.cwiseProduct(at_points));
  }

 private:
  const MatrixXd& shape_;
  const VectorXd& weights_;
  Eigen::PartialPivLU<MatrixXd> mass_;
};

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

/// All fields at one element's nodes: nodes x field_count.
MatrixXd nodal_fields(const Discretisation& space, int e, const Media& media, const VectorXd& unknowns,
                      const Scales& scales) {
  const ElementUnknowns& element = space.elements()[e];
  const auto& nodes = space.nodes().of_element[e];
  const int n = int(nodes.size()), m = element.position_columns;
  const VectorXd local = local_values(element, unknowns);
  const double um = 1e6 * scales.length_m, v_cell = unknowns(space.cell_velocity());
  const double rest_pressure = 2 * media.cortex.tension / space.mesh().geometry().radius();

  MatrixXd fields = MatrixXd::Zero(n, field_count);
  fields.col(region).setConstant(element.liquid ? 0 : 1);
  if (element.is_empty()) {
    fields.middleCols(ux, 2) = um * spoke_displacement(space, unknowns, e);
    for (int k = 0; k < n; ++k) {
      for (int c = 0; c < 2; ++c) fields(k, x + c) = um * space.node_points()[nodes[k]](c) + fields(k, ux + c);
    }
    fields.col(vx).setConstant(scales.velocity_m_per_s * v_cell);
    fields.col(pressure).setConstant(scales.stress_Pa * (rest_pressure + unknowns(space.inner_pressure())));
    return fields;
  }
  const ToNodes to_nodes(space.reference());
  for (int c = 0; c < 2; ++c) {
    if (m > 0) fields.col(ux + c) = um * (element.position->at_nodes[c] * local.segment(c * m, m));
    for (int k = 0; k < n; ++k) fields(k, x + c) = um * space.node_points()[nodes[k]](c) + fields(k, ux + c);
    if (element.liquid) fields.col(wx + c) = scales.velocity_m_per_s * local.segment(2 * m + c * n, n);
  }
  fields.col(vx) = fields.col(wx).array() + scales.velocity_m_per_s * v_cell;
  fields.col(vr) = fields.col(wr);
  const VectorXd p = space.reference().pressure.value * local.tail(space.reference().pressures());
  fields.col(pressure) = scales.stress_Pa * (to_nodes(p).array() + (element.liquid ? 0 : rest_pressure));
  fields.col(element.liquid ? shear_stress : stress) =
      scales.stress_Pa * to_nodes(stress_at_points(space, e, media, unknowns));
  return fields;
}

}  // namespace

bool write_fields(const Discretisation& space, const Media& media, const VectorXd& unknowns, const Scales& scales,
                  const std::string& path) {
  const ReferenceElement<2>& reference = space.reference();
  const int p = reference.degree(), n = reference.nodes();
  const MatrixXd basis = reference.lagrange(VectorXd::LinSpaced(p + 1, 0, 1));
  MatrixXd equidistant(n, n);  // from Gauss-Lobatto nodes to those of VTK
  for (int k = 0; k < n; ++k) {
    for (int l = 0; l < n; ++l) equidistant(k, l) = basis(k % (p + 1), l % (p + 1)) * basis(k / (p + 1), l / (p + 1));
  }
  VtuFile file(2, p);
  for (int e = 0; e < int(space.elements().size()); ++e) {
    const MatrixXd fields = equidistant * nodal_fields(space, e, media, unknowns, scales);
    file.add_element(fields.middleCols(x, 2));
    file.add_field("velocity", fields.middleCols(vx, 2));
    file.add_field("velocity_relative", fields.middleCols(wx, 2));
    file.add_field("pressure", fields.col(pressure));
    file.add_field("stress", fields.col(stress));
    file.add_field("shear_stress", fields.col(shear_stress));
    file.add_field("displacement", fields.middleCols(ux, 2));
    file.add_field("region", fields.col(region));
  }
  return file.write(path);
}

}  // namespace rheocyte
