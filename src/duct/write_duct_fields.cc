#include "duct/write_duct_fields.h"

#include <Eigen/LU>
#include <cmath>

#include "duct/observe_duct.h"
#include "fem/element_quadrature.h"
#include "fem/vtu_file.h"
#include "laws/weak_form.h"

namespace rheocyte {
namespace {

/// Columns of the nodal fields, physical units; a vector takes three.
enum Field { x = 0, v = 3, w = 6, u = 9, pressure = 12, stress, shear_stress, region, field_count };

double von_mises(Tensor<double> sigma) {
  const double mean = sigma.trace() / 3;
  for (int i = 0; i < 3; ++i) sigma(i, i) -= mean;
  return std::sqrt(1.5) * sigma.norm();
}

/// Norm of the liquid's viscous stress, or of the cell's elastic stress, at the quadrature points of an element.
VectorXd stress_at_points(const DuctSpace& space, const TensorElement& element, int e, const Media& media,
                          const VectorXd& unknowns) {
  const HexahedronUnknowns& self = space.elements()[e];
  VectorXd norm(space.reference().points());
  if (self.liquid) {
    using Fields = LiquidFields<double, 3>;
    const MatrixXd numbers = numbers_at_points<Fields>(space, element, e, unknowns);
    for (int q = 0; q < norm.size(); ++q) {
      const auto f = fields_at<Fields>(numbers, q);
      norm(q) = viscous_stress(media.liquid, gradient(PointMap<double, 3>(f.map), f.w, f.w_xi)).norm() / std::sqrt(2.0);
    }
  } else {
    using Fields = MapFields<double, 3>;
    const MatrixXd numbers = numbers_at_points<Fields>(space, element, e, unknowns);
    for (int q = 0; q < norm.size(); ++q) {
      const PointMap<double, 3> map(fields_at<Fields>(numbers, q));
      norm(q) = von_mises(elastic_stress(media.bulk, deformation_gradient(map, self.undeformed[q])));
    }
  }
  return norm;
}

/// All fields at one element's nodes: nodes x field_count.
MatrixXd nodal_fields(const DuctSpace& space, int e, const Media& media, const VectorXd& unknowns,
                      const Scales& scales) {
  const HexahedronUnknowns& self = space.elements()[e];
  const ReferenceElement<3>& reference = space.reference();
  const TensorElement element(reference.degree());
  const MatrixXd at_points = reference.lagrange(reference.points_1d);
  const MatrixXd tested = at_points.transpose() * reference.weights_1d.asDiagonal();
  const MatrixXd to_nodes = (tested * at_points).partialPivLu().solve(tested);  // the Q_p function that fits best
  const auto& nodes = space.nodes().of_element[e];
  const int n = reference.nodes();
  const double um = 1e6 * scales.length_m, U = scales.velocity_m_per_s;

  MatrixXd fields = MatrixXd::Zero(n, field_count);
  fields.col(region).setConstant(self.liquid ? 0 : 1);
  if (self.moves) fields.middleCols(u, 3) = um * values_of(self.displacement, unknowns).reshaped(n, 3);
  for (int k = 0; k < n; ++k)
    fields.block(k, x, 1, 3) = um * space.node_points()[nodes[k]].transpose() + fields.block(k, u, 1, 3);
  if (self.liquid) fields.middleCols(w, 3) = U * values_of(self.velocity, unknowns).reshaped(n, 3);
  fields.middleCols(v, 3) = fields.middleCols(w, 3);
  fields.col(v).array() += U * unknowns(space.cell_velocity());
  const VectorXd p = reference.pressure.value * values_of(self.pressure, unknowns);
  fields.col(pressure) = scales.stress_Pa * apply_in_each_direction(to_nodes, p);
  fields.col(self.liquid ? shear_stress : stress) =
      scales.stress_Pa * apply_in_each_direction(to_nodes, stress_at_points(space, element, e, media, unknowns));
  return fields;
}

}  // namespace

bool write_duct_fields(const DuctSpace& space, const Media& media, const VectorXd& unknowns, const Scales& scales,
                       const std::string& path) {
  const int p = space.reference().degree();
  const MatrixXd equidistant = space.reference().lagrange(VectorXd::LinSpaced(p + 1, 0, 1));
  VtuFile file(3, p);
  for (int e = 0; e < int(space.elements().size()); ++e) {
    const MatrixXd fields = apply_in_each_direction(equidistant, nodal_fields(space, e, media, unknowns, scales));
    file.add_element(fields.middleCols(x, 3));
    file.add_field("velocity", fields.middleCols(v, 3));
    file.add_field("velocity_relative", fields.middleCols(w, 3));
    file.add_field("pressure", fields.col(pressure));
    file.add_field("stress", fields.col(stress));
    file.add_field("shear_stress", fields.col(shear_stress));
    file.add_field("displacement", fields.middleCols(u, 3));
    file.add_field("region", fields.col(region));
  }
  return file.write(path);
}

}  // namespace rheocyte
