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

/// The numbers of a symmetric tensor in axial symmetry: xx, xr, rr, hoop.
Eigen::Vector4d components(const Tensor<double>& A) { return {A(0, 0), A(0, 1), A(1, 1), A(2, 2)}; }

Tensor<double> from_components(const Eigen::Vector4d& a) { return {a(0), a(1), 0.0, a(1), a(2), 0.0, 0.0, 0.0, a(3)}; }

}  // namespace

MovingSystem::MovingSystem(const Discretisation& space)
    : CoupledSystem(space, moving_elements(space)),
      liquid_history_(space.elements().size()),
      cell_history_(space.elements().size()) {
  ones_.value.setOnes(space.reference().points(), 1);
  set_motion({0, VectorXd::Zero(space.unknowns()), VectorXd::Zero(2 * space.nodes().count)});
}

void MovingSystem::set_motion(const Motion& motion) {
  motion_ = motion;
  for (int e = 0; e < int(elements().size()); ++e) {
    if (elements()[e].liquid) {
      if (motion_.outward.size() > 0) follow_nodes(e);
      move_surface_columns(e);
      set_liquid_history(e);
    } else {
      set_cell_history(e);
    }
  }
  if (motion_.branch.size() > 0) set_branch_history();
}

void MovingSystem::follow_nodes(int e) {
  const ElementUnknowns& moved = space().elements()[e];
  ElementUnknowns& element = elements()[e];
  element.undeformed = moved.undeformed;
  for (std::size_t i = 0; i < element.columns.size(); ++i) {
    if (element.columns[i].unknown == space().cell_velocity()) element.columns[i] = moved.columns[i];
  }
}

/// The liquid's velocity on the surface is the rate of the displacement.
void MovingSystem::move_surface_columns(int e) {
  ElementUnknowns& element = elements()[e];
  const auto& nodes = space().nodes().of_element[e];
  const int n = space().reference().nodes();
  for (int k = 0; k < 2 * n; ++k) {
    Slot& slot = element.columns[2 * element.position_columns + k];
    if (space().displacement(nodes[k % n], 0) < 0 || slot.unknown < 0) continue;
    slot.factor = motion_.rate;
    slot.constant = motion_.unknowns(slot.unknown);
  }
}

void MovingSystem::set_liquid_history(int e) {
  const ElementUnknowns& element = elements()[e];
  const ReferenceElement<2>& reference = space().reference();
  const auto& nodes = space().nodes().of_element[e];
  const int m = element.position_columns;
  Eigen::MatrixX2d mesh = Eigen::MatrixX2d::Zero(reference.points(), 2), velocity(reference.points(), 2);
  for (int c = 0; c < 2; ++c) {
    VectorXd local(m);
    for (int i = 0; i < m; ++i) {
      const int unknown = element.columns[c * m + i].unknown;
      local(i) = unknown < 0 ? 0 : motion_.unknowns(unknown);
    }
    if (m > 0) mesh.col(c) = element.position->at_points[c].value * local;
    velocity.col(c) = reference.shape.value * component_at_nodes(motion_.velocities, nodes, c);
  }
  if (motion_.outward.size() > 0) mesh.col(1) += reference.shape.value * VectorXd(motion_.outward(nodes));
  // The form knows r, not the radial displacement.
  for (int q = 0; q < reference.points(); ++q) mesh(q, 1) -= motion_.rate * element.undeformed[q].r;
  liquid_history_[e].clear();
  for (int q = 0; q < reference.points(); ++q) liquid_history_[e].push_back({mesh.row(q), velocity.row(q)});
}

void MovingSystem::set_cell_history(int e) {
  const ReferenceElement<2>& reference = space().reference();
  const auto& nodes = space().nodes().of_element[e];
  cell_history_[e].assign(reference.points(), {});
  for (int c = 0; c < 2; ++c) {
    VectorXd displacement(nodes.size());
    for (int k = 0; k < displacement.size(); ++k) {
      const int unknown = space().displacement(nodes[k], c);
      displacement(k) = unknown < 0 ? 0 : motion_.unknowns(unknown);
    }
    const VectorXd stack = reference.shape_stack * displacement;
    const VectorXd velocity = reference.shape.value * component_at_nodes(motion_.velocities, nodes, c);
    for (int q = 0, points = reference.points(); q < points; ++q) {
      // The form knows the place, not the displacement.
      const PointMap<double, 2>& X = elements()[e].undeformed[q];
      CellHistory<2>& history = cell_history_[e][q];
      history.velocity(c) = stack(q) - (c == 1 ? motion_.rate * X.r : 0);
      for (int k = 0; k < 2; ++k) history.velocity_slope(c, k) = stack((1 + k) * points + q) - motion_.rate * X.G(c, k);
      history.acceleration(c) = velocity(q);
    }
  }
}

void MovingSystem::set_branch_history() {
  Eigen::Index i = 0;
  for (auto& of_element : cell_history_) {
    for (CellHistory<2>& history : of_element) {
      history.branch = from_components(motion_.branch.segment<4>(i));
      i += 4;
    }
  }
}

VectorXd MovingSystem::branch_metric(const Bulk& bulk, const VectorXd& unknowns) const {
  VectorXd metric(unstressed_branch().size());
  Eigen::Index i = 0;
  for (int e = 0; e < int(elements().size()); ++e) {
    if (elements()[e].liquid) continue;
    int q = 0;
    for (const auto& fields : fields_at_points<MapFields<double, 2>>(space(), e, unknowns)) {
      const Tensor<double> F = deformation_gradient(PointMap<double, 2>(fields), elements()[e].undeformed[q]);
      const Tensor<double> inverse_C = inverse(Tensor<double>(F.transpose() * F));
      metric.segment<4>(i) =
          components(rheocyte::branch_metric(bulk, inverse_C, motion_.rate, cell_history_[e][q].branch));
      ++q;
      i += 4;
    }
  }
  return metric;
}

VectorXd MovingSystem::unstressed_branch() const {
  Eigen::Index points = 0;
  for (const auto& of_element : cell_history_) points += Eigen::Index(of_element.size());
  return components(Tensor<double>::Identity()).replicate(points, 1);
}

void MovingSystem::integrate(int e, const Media& media, const VectorXd& unknowns, Want want,
                             ElementSystem& system) const {
  const ElementUnknowns& element = elements()[e];
  const ReferenceElement<2>& reference = space().reference();
  ElementQuadrature<2> quadrature{reference, element.undeformed, column_groups(element, reference)};
  const VectorXd local = local_values(element, unknowns);
  if (element.liquid) {
    const MatrixXd numbers = gather_fields<MovingLiquidFields<double>>(quadrature, local);
    const auto form_at = [&](int q) { return MovingLiquidPoint{media.liquid, motion_.rate, liquid_history_[e][q]}; };
    integrate_form<MovingLiquidPoint>(quadrature, numbers, form_at, want, system);
  } else {
    quadrature.groups.push_back({&ones_, int(element.columns.size()) - 1, 1, Source::frame});
    const MatrixXd numbers = gather_fields<MovingCellFields<double, 2>>(quadrature, local);
    const double excess = media.bulk.reynolds - media.liquid.reynolds;
    const double frame_history = motion_.unknowns(space().cell_velocity());
    const auto form_at = [&](int q) {
      return MovingCellPoint<2>{media.bulk,   element.undeformed[q], excess,
                                motion_.rate, cell_history_[e][q],   frame_history};
    };
    integrate_form<MovingCellPoint<2>>(quadrature, numbers, form_at, want, system);
  }
}

CoupledSystem::InletPressure MovingSystem::inlet_pressure(const Media& media) const {
  // The solver's pressure contains that of the inertial force (eq:frame-pressure).
  const double mass = media.liquid.reynolds * 2 * space().mesh().geometry().end();
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
