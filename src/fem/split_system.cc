#include "fem/split_system.h"

#include "fem/element_quadrature.h"
#include "fem/end_loads.h"
#include "laws/moving_form.h"
#include "laws/split_form.h"

namespace rheocyte {
namespace {

/// Marks displacements and pressures of the cell, or velocities and pressures of the liquid.
std::vector<bool> members(const Discretisation& space, bool cell) {
  std::vector<bool> wanted(space.unknowns(), false);
  for (int e = 0; e < int(space.elements().size()); ++e) {
    if (space.elements()[e].liquid == cell) continue;
    for (int k = 0; k < space.reference().pressures(); ++k) wanted[space.pressure(e, k)] = true;
  }
  for (int i = 0; i < 2 * space.nodes().count; ++i) {
    const int unknown = cell ? space.displacement(i / 2, i % 2) : space.velocity(i / 2, i % 2).unknown;
    if (unknown >= 0 && unknown != space.cell_velocity()) wanted[unknown] = true;
  }
  return wanted;
}

VectorXd values_at_nodes(const VectorXd& field, const std::vector<int>& nodes, int c) {
  VectorXd values(nodes.size());
  for (int k = 0; k < values.size(); ++k) values(k) = field(2 * nodes[k] + c);
  return values;
}

void add_residual(const ElementUnknowns& element, const VectorXd& residual, VectorXd& total) {
  for (int i = 0; i < residual.size(); ++i) {
    if (element.rows[i] >= 0) total(element.rows[i]) += residual(i);
  }
}

}  // namespace

SplitSystem::SplitSystem(const Discretisation& space)
    : space_(space),
      elements_(space.elements()),
      surface_(space),
      liquid_(elements_, members(space, false)),
      cell_(elements_, members(space, true)) {}

void SplitSystem::tell_surface_velocity(const SplitState& state) {
  const int n = space_.reference().nodes();
  const double v_cell = state.unknowns(space_.cell_velocity());
  surface_velocity_.setZero(space_.unknowns());
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    ElementUnknowns& element = elements_[e];
    if (!element.liquid) continue;
    for (int k = 0; k < 2 * n; ++k) {
      const int node = space_.nodes().of_element[e][k % n], c = k / n;
      if (space_.displacement(node, 0) < 0) continue;
      const double v = state.velocities(2 * node + c) - (c == 0 ? v_cell : 0);
      element.columns[2 * element.position_columns + k] = {-1, 1, v};
      if (const int displacement = space_.displacement(node, c); displacement >= 0) surface_velocity_(displacement) = v;
    }
  }
}

void SplitSystem::integrate_liquid(int e, const Media& media, double step, const SplitState& before,
                                   const VectorXd& unknowns, Want want) {
  const ElementUnknowns& element = elements_[e];
  const ReferenceElement& reference = space_.reference();
  const auto& nodes = space_.nodes().of_element[e];
  const int m = element.position_columns;
  const double v_cell = unknowns(space_.cell_velocity());
  std::vector<ColumnGroup> groups = column_groups(element, reference);
  const VectorXd local = local_values(element, unknowns);
  MatrixXd fields = MatrixXd::Zero(reference.points(), MovingLiquidPoint::inputs);
  fields.leftCols(LiquidPoint::inputs) = gather_fields({reference, element, groups}, LiquidPoint::inputs, local);
  // The mesh follows the surface: along spokes its velocity is linear in the surface's.
  MatrixXd mesh = MatrixXd::Zero(reference.points(), 2), history(reference.points(), 2);
  for (int c = 0; c < 2; ++c) {
    VectorXd foot(m);
    for (int k = 0; k < m; ++k) {
      const int displacement = element.columns[c * m + k].unknown;
      foot(k) = displacement < 0 ? 0 : surface_velocity_(displacement);
    }
    if (m > 0) mesh.col(c) = element.position[c].value * foot;
    VectorXd old = values_at_nodes(before.velocities, nodes, c);
    if (c == 0) old.array() -= v_cell;
    history.col(c) = reference.shape.value * old / -step;
  }
  if (m > 0) groups.erase(groups.begin(), groups.begin() + 2);  // positions are known
  const double rate = 1 / step;
  const auto form_at = [&](int q) {
    const PlaneVector<double> velocity(mesh(q, 0) - rate * fields(q, 12), mesh(q, 1) - rate * fields(q, 4));
    return MovingLiquidPoint{media.liquid, rate, velocity, {history(q, 0), history(q, 1)}};
  };
  integrate_form<MovingLiquidPoint>({reference, element, groups}, fields, form_at, want, element_);
}

void SplitSystem::integrate_cell(int e, const Media& media, double step, const SplitState& state) {
  const ElementUnknowns& element = elements_[e];
  const ReferenceElement& reference = space_.reference();
  const auto& nodes = space_.nodes().of_element[e];
  const int n = reference.nodes(), modes = reference.pressures();
  const MatrixXd here = fields_at_points(space_, e, state.unknowns);
  const std::vector<ColumnGroup> groups = {{&reference.shape, 0, n, {{0, Part::value}, {2, Part::d1}, {3, Part::d2}}},
                                           {&reference.shape, n, n, {{1, Part::value}, {4, Part::d1}, {5, Part::d2}}},
                                           {&reference.pressure, 2 * n, modes, {{6, Part::value}}}};
  MatrixXd fields = MatrixXd::Zero(reference.points(), SplitCellPoint::inputs);
  for (int c = 0; c < 2; ++c) {
    const VectorXd v = values_at_nodes(state.velocities, nodes, c);
    for (const Feed& feed : groups[c].feeds) fields.col(feed.input) = table(reference.shape, feed.part) * v;
  }
  fields.col(6) = here.col(5);
  const auto form_at = [&](int q) {
    Plane<double> G;
    G << here(q, 0), here(q, 1), here(q, 2), here(q, 3);
    return SplitCellPoint{
        media.bulk, element.reference[q], Place<double>(G, here(q, 4)), 1 / step, {fields(q, 0), fields(q, 1)}};
  };
  evaluate_points<SplitCellPoint>(fields, reference.weights, form_at, Want::residual_and_tangent, element_);
  test_residual(reference, element_);
  test_tangent<SplitCellPoint>(reference, groups, int(element.columns.size()), element_);
}

bool SplitSystem::step_liquid(const Media& media, double step, SplitState& state, VectorXd& load) {
  tell_surface_velocity(state);
  const double inlet_pressure = undisturbed_inlet_pressure(space_, media.liquid) + state.inlet_pressure;
  VectorXd residual = outlet_load(space_, media.liquid) + inlet_pressure * inlet_load(space_);
  liquid_.clear();
  for (int e = 0; e < int(elements_.size()); ++e) {
    if (!elements_[e].liquid) continue;
    integrate_liquid(e, media, step, state, state.unknowns, Want::residual_and_tangent);
    add_residual(elements_[e], element_.residual, residual);
    liquid_.add(e, element_.tangent);
  }
  ++factorisations_;
  if (!liquid_.factorise()) return false;
  state.unknowns -= liquid_.solve(residual);
  load = VectorXd::Zero(space_.unknowns());
  for (int e = 0; e < int(elements_.size()); ++e) {
    if (!elements_[e].liquid) continue;
    integrate_liquid(e, media, step, state, state.unknowns, Want::residual);
    add_residual(elements_[e], element_.residual, load);
  }
  for (int k = 0; k < surface_.active(media.cortex); ++k) {
    surface_.integrate(k, media.cortex, state.unknowns, Want::residual, element_);
    const auto& rows = surface_.patches()[k].unknowns;
    for (int i = 0; i < int(rows.size()); ++i) {
      if (rows[i] >= 0) load(rows[i]) += element_.residual(i);
    }
  }
  for (int node = 0; node < space_.nodes().count; ++node) {
    if (space_.displacement(node, 0) >= 0) continue;
    for (int c = 0; c < 2; ++c)
      state.velocities(2 * node + c) =
          space_.velocity(node, c).value(state.unknowns) + (c == 0 ? state.unknowns(space_.cell_velocity()) : 0);
  }
  return load.allFinite();
}

bool SplitSystem::step_cell(const Media& media, double step, SplitState& state) {
  VectorXd residual = state.traction;
  cell_.clear();
  for (int e = 0; e < int(elements_.size()); ++e) {
    if (elements_[e].liquid) continue;
    integrate_cell(e, media, step, state);
    add_residual(elements_[e], element_.residual, residual);
    cell_.add(e, element_.tangent);
  }
  ++factorisations_;
  if (!cell_.factorise()) return false;
  const VectorXd correction = cell_.solve(residual);  // of velocities in the places of displacements, and of pressures
  for (int i = 0; i < 2 * space_.nodes().count; ++i) {
    const int unknown = space_.displacement(i / 2, i % 2);
    if (unknown >= 0) state.velocities(i) -= correction(unknown);
  }
  for (int e = 0; e < int(elements_.size()); ++e) {
    for (int k = 0; !elements_[e].liquid && k < space_.reference().pressures(); ++k) {
      const int unknown = space_.pressure(e, k);
      state.unknowns(unknown) -= correction(unknown);
    }
  }
  return correction.allFinite();
}

double SplitSystem::mean_velocity(const SplitState& state) const {
  const ReferenceElement& reference = space_.reference();
  double momentum = 0, volume = 0;
  for (int e = 0; e < int(elements_.size()); ++e) {
    if (elements_[e].liquid) continue;
    const MatrixXd here = fields_at_points(space_, e, state.unknowns);
    const VectorXd v = reference.shape.value * values_at_nodes(state.velocities, space_.nodes().of_element[e], 0);
    const Eigen::ArrayXd det = here.col(0).array() * here.col(3).array() - here.col(1).array() * here.col(2).array();
    const Eigen::ArrayXd weight = reference.weights.array() * det * here.col(4).array();
    momentum += (weight * v.array()).sum();
    volume += weight.sum();
  }
  return momentum / volume;
}

void SplitSystem::move(double step, SplitState& state) const {
  const double v_cell = mean_velocity(state);
  for (int i = 0; i < 2 * space_.nodes().count; ++i) {
    const int unknown = space_.displacement(i / 2, i % 2);
    if (unknown >= 0) state.unknowns(unknown) += step * (state.velocities(i) - (i % 2 == 0 ? v_cell : 0));
    const Slot& slot = space_.velocity(i / 2, i % 2);
    if (space_.displacement(i / 2, 0) >= 0 || slot.unknown < 0 || slot.unknown == space_.cell_velocity()) continue;
    state.unknowns(slot.unknown) = state.velocities(i) - (i % 2 == 0 ? v_cell : 0);
  }
  state.unknowns(space_.cell_velocity()) = v_cell;
}

}  // namespace rheocyte
