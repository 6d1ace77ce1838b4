#include "fem/element_integrals.h"

#include "fem/element_quadrature.h"

namespace rheocyte {

std::vector<ColumnGroup<2>> column_groups(const ElementUnknowns& element, const ReferenceElement<2>& reference) {
  const int n = reference.nodes(), m = element.position_columns, first_velocity = 2 * m;
  std::vector<ColumnGroup<2>> groups;
  for (int c = 0; c < 2 && m > 0; ++c)
    groups.push_back({&element.position->at_points[c], c * m, m, Source::position, c});
  for (int c = 0; c < 2 && element.liquid; ++c)
    groups.push_back({&reference.shape, first_velocity + c * n, n, Source::velocity, c});
  const int first_pressure = first_velocity + (element.liquid ? 2 * n : 0);
  groups.push_back({&reference.pressure, first_pressure, reference.pressures(), Source::pressure});
  return groups;
}

VectorXd local_values(const ElementUnknowns& element, const VectorXd& unknowns) {
  VectorXd local(element.columns.size());
  for (int i = 0; i < local.size(); ++i) local(i) = element.columns[i].value(unknowns);
  return local;
}

MatrixXd points_of_nodes(const Discretisation& space, int e, const VectorXd& unknowns) {
  const ElementUnknowns& element = space.elements()[e];
  const auto& nodes = space.nodes().of_element[e];
  const int m = element.position_columns;
  MatrixXd points(nodes.size(), 2);
  for (int k = 0; k < points.rows(); ++k) points.row(k) = space.node_points()[nodes[k]].transpose();
  const VectorXd local = local_values(element, unknowns);
  for (int c = 0; c < 2 && m > 0; ++c) points.col(c) += element.position->at_nodes[c] * local.segment(c * m, m);
  return points;
}

namespace {

ElementQuadrature<2> quadrature_of(const Discretisation& space, int e) {
  const ElementUnknowns& element = space.elements()[e];
  return {space.reference(), element.undeformed, column_groups(element, space.reference())};
}

}  // namespace

template <class Fields>
std::vector<Fields> fields_at_points(const Discretisation& space, int e, const VectorXd& unknowns) {
  const MatrixXd numbers = gather_fields<Fields>(quadrature_of(space, e), local_values(space.elements()[e], unknowns));
  std::vector<Fields> fields;
  for (int q = 0; q < numbers.rows(); ++q) fields.push_back(fields_at<Fields>(numbers, q));
  return fields;
}

template std::vector<MapFields<double, 2>> fields_at_points(const Discretisation&, int, const VectorXd&);
template std::vector<CellFields<double, 2>> fields_at_points(const Discretisation&, int, const VectorXd&);
template std::vector<LiquidFields<double, 2>> fields_at_points(const Discretisation&, int, const VectorXd&);

void integrate_element(const Discretisation& space, int e, const Media& media, const VectorXd& unknowns, Want want,
                       ElementSystem& system) {
  const ElementUnknowns& element = space.elements()[e];
  const ElementQuadrature<2> quadrature = quadrature_of(space, e);
  const VectorXd local = local_values(element, unknowns);
  if (element.liquid) {
    const MatrixXd numbers = gather_fields<LiquidFields<double, 2>>(quadrature, local);
    const auto form_at = [&](int) { return LiquidPoint<2>{media.liquid}; };
    integrate_form<LiquidPoint<2>>(quadrature, numbers, form_at, want, system);
  } else {
    const MatrixXd numbers = gather_fields<CellFields<double, 2>>(quadrature, local);
    const auto form_at = [&](int q) { return CellPoint<2>{media.bulk, element.undeformed[q]}; };
    integrate_form<CellPoint<2>>(quadrature, numbers, form_at, want, system);
  }
}

}  // namespace rheocyte
