#include "duct/duct_nodal_fields.h"

#include <cmath>

#include "fem/element_quadrature.h"
#include "fem/nodal_fields.h"
#include "laws/weak_form.h"

namespace rheocyte {

DuctNodalFields::DuctNodalFields(const DuctSpace& space, const Media& media, const VectorXd& unknowns,
                                 const Scales& scales)
    : space_(space),
      media_(media),
      unknowns_(unknowns),
      scales_(scales),
      element_(space.reference().degree()),
      to_nodes_(space.reference().points_to_nodes()) {}

VectorXd DuctNodalFields::at_nodes(const VectorXd& at_points) const {
  return apply_in_each_direction(to_nodes_, at_points);
}

void DuctNodalFields::add_liquid_stress(int e, MatrixXd& fields) const {
  using Fields = LiquidFields<double, 3>;
  const MatrixXd numbers = numbers_at_points<Fields>(space_, element_, e, unknowns_);
  VectorXd norm(space_.reference().points()), rates(norm.size());
  for (int q = 0; q < norm.size(); ++q) {
    const auto f = fields_at<Fields>(numbers, q);
    const Tensor<double> L = gradient(PointMap<double, 3>(f.map), f.w, f.w_xi);
    norm(q) = viscous_stress(media_.liquid, L).norm() / std::sqrt(2.0);
    rates(q) = shear_rate(L);
  }
  fields.col(shear_stress) = scales_.stress_Pa * at_nodes(norm);
  fields.col(rate) = at_nodes(rates) / scales_.time_s();
}

void DuctNodalFields::add_cell_stress(int e, MatrixXd& fields) const {
  using Fields = MapFields<double, 3>;
  const MatrixXd numbers = numbers_at_points<Fields>(space_, element_, e, unknowns_);
  VectorXd norm(space_.reference().points()), stretches(norm.size());
  for (int q = 0; q < norm.size(); ++q) {
    const PointMap<double, 3> map(fields_at<Fields>(numbers, q));
    const Tensor<double> F = deformation_gradient(map, space_.elements()[e].undeformed[q]);
    norm(q) = von_mises(elastic_stress(media_.bulk, F));
    stretches(q) = max_stretch(F);
  }
  fields.col(stress) = scales_.stress_Pa * at_nodes(norm);
  fields.col(stretch) = at_nodes(stretches);
}

MatrixXd DuctNodalFields::of_element(int e) const {
  const HexahedronUnknowns& self = space_.elements()[e];
  const auto& nodes = space_.nodes().of_element[e];
  const int n = space_.reference().nodes();
  const double um = scales_.length_um(), U = scales_.velocity_m_per_s;

  MatrixXd fields = MatrixXd::Zero(n, columns);
  fields.col(region).setConstant(self.liquid ? 0 : 1);
  if (self.moves) fields.middleCols(u, 3) = um * values_of(self.displacement, unknowns_).reshaped(n, 3);
  for (int k = 0; k < n; ++k)
    fields.block(k, x, 1, 3) = um * space_.node_points()[nodes[k]].transpose() + fields.block(k, u, 1, 3);
  if (self.liquid) fields.middleCols(w, 3) = U * values_of(self.velocity, unknowns_).reshaped(n, 3);
  fields.middleCols(v, 3) = fields.middleCols(w, 3);
  fields.col(v).array() += U * unknowns_(space_.cell_velocity());
  const double at_rest = self.liquid ? 0 : rest_pressure(media_.cortex, space_.mesh().geometry().radius());
  const VectorXd p = space_.reference().pressure.value * values_of(self.pressure, unknowns_);
  fields.col(pressure) = scales_.stress_Pa * (at_nodes(p).array() + at_rest);
  if (self.liquid) {
    add_liquid_stress(e, fields);
  } else if (!self.is_empty) {
    add_cell_stress(e, fields);
  }
  return fields;
}

}  // namespace rheocyte
