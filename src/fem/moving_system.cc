#include "fem/moving_system.h"

#include <cassert>

#include "fem/element_quadrature.h"

namespace rheocyte {
namespace {

/// The stationary elements; in the liquid the surface now moves, in the cell the frame's acceleration is felt.
std::vector<ElementUnknowns> moving_elements(const Discretisation& space) {
  std::vector<ElementUnknowns> elements = space.elements();
  const int n = space.reference().nodes();
  for (std::size_t e = 0; e < elements.size(); ++e) {
    ElementUnknowns& element = elements[e];
    assert(!element.is_empty());
    if (!element.liquid) {
      element.columns.push_back({space.cell_velocity()});
      continue;
    }
    for (int k = 0; k < 2 * n; ++k) {
      const int node = space.nodes().of_element[e][k % n], c = k / n;
      if (space.displacement(node, 0) < 0) continue;
      element.columns[2 * element.position_columns + k] = {space.displacement(node, c), 0, 0};
    }
  }
  return elements;
}

/// The groups of the stationary problem, and what feeds the inputs that come after its own.
std::vector<ColumnGroup> moving_groups(const ElementUnknowns& element, const ReferenceElement& reference,
                                       const ShapeTable& ones) {
  std::vector<ColumnGroup> groups = column_groups(element, reference);
  const int first = element.liquid ? LiquidPoint::inputs : CellPoint::inputs;
  if (element.position_columns > 0) groups.front().feeds.push_back({first, Part::value});
  if (!element.liquid) groups.push_back({&ones, int(element.columns.size()) - 1, 1, {{first + 1, Part::value}}});
  return groups;
}

}  // namespace

MovingSystem::MovingSystem(const Discretisation& space) : CoupledSystem(space, moving_elements(space)) {
  ones_.value.setOnes(space.reference().points(), 1);
  set_motion({0, VectorXd::Zero(space.unknowns()), VectorXd::Zero(2 * space.nodes().count)});
}

void MovingSystem::set_motion(const Motion& motion) {
  motion_ = motion;
  history_.resize(elements().size());
  for (int e = 0; e < int(elements().size()); ++e) {
    if (elements()[e].liquid) {
      if (motion_.outward.size() > 0) follow_nodes(e);
      tell_liquid(e);
    } else {
      tell_cell(e);
    }
  }
}

void MovingSystem::follow_nodes(int e) {
  const ElementUnknowns& moved = space().elements()[e];
  ElementUnknowns& element = elements()[e];
  element.reference = moved.reference;
  for (std::size_t i = 0; i < element.columns.size(); ++i) {
    if (element.columns[i].unknown == space().cell_velocity()) element.columns[i] = moved.columns[i];
  }
}

void MovingSystem::tell_liquid(int e) {
  ElementUnknowns& element = elements()[e];
  const ReferenceElement& reference = space().reference();
  const auto& nodes = space().nodes().of_element[e];
  const int n = reference.nodes(), m = element.position_columns;
  MatrixXd& history = history_[e];
  history.setZero(reference.points(), 4);
  VectorXd local(2 * m), velocity(n);
  for (int i = 0; i < 2 * m; ++i) {
    const int unknown = element.columns[i].unknown;
    local(i) = unknown < 0 ? 0 : motion_.unknowns(unknown);
  }
  for (int c = 0; c < 2; ++c) {
    if (m > 0) history.col(c) = element.position[c].value * local.segment(c * m, m);
    for (int k = 0; k < n; ++k) {
      velocity(k) = motion_.velocities(2 * nodes[k] + c);
      Slot& slot = element.columns[2 * m + c * n + k];
      if (space().displacement(nodes[k], 0) < 0 || slot.unknown < 0) continue;
      slot.factor = motion_.rate;
      slot.constant = motion_.unknowns(slot.unknown);
    }
    history.col(2 + c) = reference.shape.value * velocity;
  }
  if (motion_.outward.size() > 0) {
    for (int k = 0; k < n; ++k) velocity(k) = motion_.outward(nodes[k]);
    history.col(1) += reference.shape.value * velocity;
  }
  // The form knows r, not the radial displacement.
  for (int q = 0; q < reference.points(); ++q) history(q, 1) -= motion_.rate * element.reference[q].r;
}

void MovingSystem::tell_cell(int e) {
  const ElementUnknowns& element = elements()[e];
  const ReferenceElement& reference = space().reference();
  const auto& nodes = space().nodes().of_element[e];
  MatrixXd& history = history_[e];
  history.setZero(reference.points(), 8);
  VectorXd displacement(nodes.size()), velocity(nodes.size());
  for (int c = 0; c < 2; ++c) {
    for (int k = 0; k < int(nodes.size()); ++k) {
      const int unknown = space().displacement(nodes[k], c);
      displacement(k) = unknown < 0 ? 0 : motion_.unknowns(unknown);
      velocity(k) = motion_.velocities(2 * nodes[k] + c);
    }
    history.col(c) = reference.shape.value * displacement;
    history.col(2 + 2 * c) = reference.shape.d1 * displacement;
    history.col(3 + 2 * c) = reference.shape.d2 * displacement;
    history.col(6 + c) = reference.shape.value * velocity;
  }
  // The form knows the place, not the displacement.
  for (int q = 0; q < reference.points(); ++q) {
    const Place<double>& X = element.reference[q];
    history(q, 1) -= motion_.rate * X.r;
    for (int i = 0; i < 4; ++i) history(q, 2 + i) -= motion_.rate * X.G(i / 2, i % 2);
  }
}

CellHistory MovingSystem::cell_history(int e, int q) const {
  const auto row = history_[e].row(q);
  CellHistory history;
  history.velocity << row(0), row(1);
  history.velocity_slope << row(2), row(3), row(4), row(5);
  history.acceleration << row(6), row(7);
  history.frame_acceleration = motion_.unknowns(space().cell_velocity());
  return history;
}

void MovingSystem::integrate(int e, const Media& media, const VectorXd& unknowns, Want want,
                             ElementSystem& system) const {
  const ElementUnknowns& element = elements()[e];
  const ReferenceElement& reference = space().reference();
  const ElementQuadrature quadrature{reference, element, moving_groups(element, reference, ones_)};
  const VectorXd local = local_values(element, unknowns);
  if (element.liquid) {
    const MatrixXd fields = gather_fields(quadrature, MovingLiquidPoint::inputs, local);
    const auto form_at = [&](int q) {
      const auto row = history_[e].row(q);
      return MovingLiquidPoint{media.liquid, motion_.rate, {row(0), row(1)}, {row(2), row(3)}};
    };
    integrate_form<MovingLiquidPoint>(quadrature, fields, form_at, want, system);
  } else {
    const MatrixXd fields = gather_fields(quadrature, MovingCellPoint::inputs, local);
    const double excess = media.bulk.reynolds - media.liquid.reynolds;
    const auto form_at = [&](int q) {
      return MovingCellPoint{media.bulk, element.reference[q], excess, motion_.rate, cell_history(e, q)};
    };
    integrate_form<MovingCellPoint>(quadrature, fields, form_at, want, system);
  }
}

CoupledSystem::InletPressure MovingSystem::inlet_pressure(const Media& media) const {
  // The solver's pressure contains that of the inertial force (eq:frame-pressure).
  const double mass = media.liquid.reynolds * 2 * space().mesh().geometry().half_length();
  InletPressure pressure = CoupledSystem::inlet_pressure(media);
  pressure.fixed -= mass * motion_.unknowns(space().cell_velocity());
  pressure.slope -= mass * motion_.rate;
  return pressure;
}

VectorXd MovingSystem::node_velocities(const VectorXd& unknowns) const {
  VectorXd velocities(2 * space().nodes().count);
  for (int i = 0; i < velocities.size(); ++i) {
    const int node = i / 2, c = i % 2, displacement = space().displacement(node, c);
    const bool cell = space().displacement(node, 0) >= 0;
    velocities(i) = !cell               ? space().velocity(node, c).value(unknowns)
                    : displacement >= 0 ? motion_.rate * unknowns(displacement) + motion_.unknowns(displacement)
                                        : 0;
  }
  return velocities;
}

}  // namespace rheocyte
