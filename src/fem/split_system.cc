#include "fem/split_system.h"

#include "fem/element_quadrature.h"
#include "fem/end_loads.h"
#include "laws/moving_form.h"
#include "laws/split_form.h"

namespace rheocyte {
namespace {

void add_residual(const ElementUnknowns& element, const VectorXd& residual, VectorXd& total) {
  for (int i = 0; i < residual.size(); ++i) {
    if (element.rows[i] >= 0) total(element.rows[i]) += residual(i);
  }
}

}  // namespace

SplitSystem::SplitSystem(const Discretisation& space)
    : space_(space), elements_(space.elements()), surface_(space), liquid_(space, true), cell_(space, false) {}

void SplitSystem::set_surface_velocity(const SplitState& state) {
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
  const ReferenceElement<2>& reference = space_.reference();
  const auto& nodes = space_.nodes().of_element[e];
  const int m = element.position_columns;
  const double v_cell = unknowns(space_.cell_velocity()), rate = 1 / step;
  ElementQuadrature<2> quadrature{reference, element.undeformed, column_groups(element, reference)};
  const MatrixXd numbers = gather_fields<MovingLiquidFields<double>>(quadrature, local_values(element, unknowns));
  // The mesh follows the surface: along spokes its velocity is linear in the surface's.
  Eigen::MatrixX2d mesh = Eigen::MatrixX2d::Zero(reference.points(), 2), velocity(reference.points(), 2);
  for (int c = 0; c < 2; ++c) {
    VectorXd foot(m);
    for (int k = 0; k < m; ++k) {
      const int displacement = element.columns[c * m + k].unknown;
      foot(k) = displacement < 0 ? 0 : surface_velocity_(displacement);
    }
    if (m > 0) mesh.col(c) = element.position->at_points[c].value * foot;
    VectorXd old = component_at_nodes(before.velocities, nodes, c);
    if (c == 0) old.array() -= v_cell;
    velocity.col(c) = reference.shape.value * old * -rate;
  }
  std::erase_if(quadrature.groups, [](const auto& group) { return group.source == Source::position; });  // known
  const auto form_at = [&](int q) {
    const auto f = fields_at<MovingLiquidFields<double>>(numbers, q);
    const Components<double, 2> mesh_history(mesh(q, 0) - rate * f.u_x, mesh(q, 1) - rate * f.map.r);
    return MovingLiquidPoint{media.liquid, rate, {mesh_history, velocity.row(q)}};
  };
  integrate_form<MovingLiquidPoint>(quadrature, numbers, form_at, want, element_);
}

void SplitSystem::integrate_cell(int e, const Media& media, double step, const SplitState& state) {
  const ElementUnknowns& element = elements_[e];
  const ReferenceElement<2>& reference = space_.reference();
  const int n = reference.nodes(), modes = reference.pressures();
  // Velocities take the places of the displacements.
  const ElementQuadrature<2> quadrature{reference,
                                        element.undeformed,
                                        {{&reference.shape, 0, n, Source::velocity, 0},
                                         {&reference.shape, n, n, Source::velocity, 1},
                                         {&reference.pressure, 2 * n, modes, Source::pressure}}};
  VectorXd local = local_values(element, state.unknowns);
  for (int c = 0; c < 2; ++c)
    local.segment(c * n, n) = component_at_nodes(state.velocities, space_.nodes().of_element[e], c);
  const MatrixXd numbers = gather_fields<SplitCellFields<double>>(quadrature, local);
  const auto here = fields_at_points<MapFields<double, 2>>(space_, e, state.unknowns);
  const auto form_at = [&](int q) {
    const auto before = fields_at<SplitCellFields<double>>(numbers, q);
    return SplitCellPoint{media.bulk, element.undeformed[q], PointMap<double, 2>(here[q]), 1 / step, before.v};
  };
  integrate_form<SplitCellPoint>(quadrature, numbers, form_at, Want::residual_and_tangent, element_);
}

bool SplitSystem::step_liquid(const Media& media, double step, SplitState& state, VectorXd& load) {
  set_surface_velocity(state);
  const double undisturbed = undisturbed_inlet_pressure(space_, media.liquid);
  VectorXd residual = (undisturbed + state.inlet_pressure) * inlet_load(space_) - undisturbed * outlet_load(space_);
  for (int e = 0; e < int(elements_.size()); ++e) {
    if (!elements_[e].liquid) continue;
    integrate_liquid(e, media, step, state, state.unknowns, Want::residual_and_tangent);
    add_residual(elements_[e], element_.residual, residual);
    liquid_.add(e, element_.tangent);
  }
  ++factorisations_;
  if (!liquid_.is_regular()) return false;
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
  for (int e = 0; e < int(elements_.size()); ++e) {
    if (elements_[e].liquid) continue;
    integrate_cell(e, media, step, state);
    add_residual(elements_[e], element_.residual, residual);
    cell_.add(e, element_.tangent);
  }
  ++factorisations_;
  if (!cell_.is_regular()) return false;
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
  const ReferenceElement<2>& reference = space_.reference();
  double momentum = 0, volume = 0;
  for (int e = 0; e < int(elements_.size()); ++e) {
    if (elements_[e].liquid) continue;
    const VectorXd v = reference.shape.value * component_at_nodes(state.velocities, space_.nodes().of_element[e], 0);
    int q = 0;
    for (const auto& fields : fields_at_points<MapFields<double, 2>>(space_, e, state.unknowns)) {
      const double weight = reference.weights(q) * PointMap<double, 2>(fields).volume();
      momentum += weight * v(q++);
      volume += weight;
    }
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
