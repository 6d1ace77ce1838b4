#include "fem/element_integrals.h"

#include "fem/element_quadrature.h"

namespace rheocyte {

std::vector<ColumnGroup> column_groups(const ElementUnknowns& element, const ReferenceElement& reference) {
  const int n = reference.nodes(), m = element.position_columns;
  std::vector<ColumnGroup> groups;
  if (m > 0) {
    groups.push_back({&element.position[0], 0, m, {{0, Part::d1}, {1, Part::d2}}});
    groups.push_back({&element.position[1], m, m, {{2, Part::d1}, {3, Part::d2}, {4, Part::value}}});
  }
  if (element.liquid) {
    const ShapeTable* shape = &reference.shape;
    groups.push_back({shape, 2 * m, n, {{5, Part::value}, {7, Part::d1}, {8, Part::d2}}});
    groups.push_back({shape, 2 * m + n, n, {{6, Part::value}, {9, Part::d1}, {10, Part::d2}}});
  }
  const int pressure_input = (element.liquid ? LiquidPoint::inputs : CellPoint::inputs) - 1;
  const int pressures = element.liquid ? 2 * (m + n) : 2 * m, modes = reference.pressures();
  groups.push_back({&reference.pressure, pressures, modes, {{pressure_input, Part::value}}});
  return groups;
}

VectorXd local_values(const ElementUnknowns& element, const VectorXd& unknowns) {
  VectorXd local(element.columns.size());
  for (int i = 0; i < local.size(); ++i) local(i) = element.columns[i].value(unknowns);
  return local;
}

MatrixXd fields_at_points(const Discretisation& space, int e, const VectorXd& unknowns) {
  const ElementUnknowns& element = space.elements()[e];
  const ElementQuadrature quadrature{space.reference(), element, column_groups(element, space.reference())};
  return gather_fields(quadrature, element.liquid ? LiquidPoint::inputs : CellPoint::inputs,
                       local_values(element, unknowns));
}

void integrate_element(const Discretisation& space, int e, const Media& media, const VectorXd& unknowns, Want want,
                       ElementSystem& system) {
  const ElementUnknowns& element = space.elements()[e];
  const ElementQuadrature quadrature{space.reference(), element, column_groups(element, space.reference())};
  const MatrixXd fields = fields_at_points(space, e, unknowns);
  if (element.liquid) {
    const auto form_at = [&](int) { return LiquidPoint{media.liquid}; };
    integrate_form<LiquidPoint>(quadrature, fields, form_at, want, system);
  } else {
    const auto form_at = [&](int q) { return CellPoint{media.bulk, element.reference[q]}; };
    integrate_form<CellPoint>(quadrature, fields, form_at, want, system);
  }
}

}  // namespace rheocyte
