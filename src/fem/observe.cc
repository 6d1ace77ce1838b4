#include "fem/observe.h"

#include <algorithm>
#include <cmath>

#include "laws/surface_form.h"
#include "numeric/parabola.h"

namespace rheocyte {
namespace {

/// Nodal values of a two-component field on one element, from any source.
template <class NodeValue>
Eigen::MatrixX2d nodal_field(const std::vector<int>& nodes, const NodeValue& at) {
  Eigen::MatrixX2d field(nodes.size(), 2);
  for (int k = 0; k < int(nodes.size()); ++k) {
    for (int c = 0; c < 2; ++c) field(k, c) = at(nodes[k], c);
  }
  return field;
}

/// One element's fields of a state: displacement or velocity at the nodes, and pressure modes.
struct ElementFields {
  Eigen::MatrixX2d vector;
  VectorXd pressure;
};

ElementFields element_fields(const Discretisation& space, const VectorXd& unknowns, int e) {
  const bool liquid = space.elements()[e].liquid;
  ElementFields fields;
  fields.vector = nodal_field(space.nodes().of_element[e], [&](int node, int c) {
    if (liquid) return space.velocity(node, c).value(unknowns);
    return current_point(space, unknowns, node)(c) - space.node_points()[node](c);
  });
  fields.pressure.setZero(space.reference().pressures());
  if (space.elements()[e].is_empty()) return fields;
  for (int k = 0; k < fields.pressure.size(); ++k) fields.pressure(k) = unknowns(space.pressure(e, k));
  return fields;
}

/// Coordinates in element `other` of the coordinates `xi` of element `self` of the same block, one direction.
VectorXd coordinates_in(const MeshElement& self, const MeshElement& other, int direction, const VectorXd& xi) {
  const bool outward = (direction == 0) == self.outward_first;
  const auto& mine = outward ? self.outward : self.along;
  const auto& theirs = outward ? other.outward : other.along;
  return ((mine[0] - theirs[0]) + xi.array() * (mine[1] - mine[0])) / (theirs[1] - theirs[0]);
}

bool inside(double xi) { return xi > -1e-10 && xi < 1 + 1e-10; }

/// Calls visit(i, j, xi1, xi2, other) for each pair of coordinates (a(i), a(j)) of element `e` of `to`, with the
/// element of `from` that holds the point and its coordinates there.
template <class Visit>
void locate(const ChannelMesh& from, const MeshElement& self, const VectorXd& a, const Visit& visit) {
  for (int f = 0; f < int(from.elements().size()); ++f) {
    const MeshElement& other = from.elements()[f];
    if (other.block != self.block) continue;
    if (self.is_skewed() || other.is_skewed()) {
      for (int k = 0; k < a.size() * a.size(); ++k) {
        const int i = k % int(a.size()), j = k / int(a.size());
        const auto [out, along] = self.parameters(a(i), a(j));
        const auto [xi1, xi2] = other.coordinates(out, along);
        if (inside(xi1) && inside(xi2)) visit(i, j, xi1, xi2, f);
      }
      continue;
    }
    const VectorXd xi1 = coordinates_in(self, other, 0, a), xi2 = coordinates_in(self, other, 1, a);
    for (int j = 0; j < a.size(); ++j) {
      for (int i = 0; i < a.size(); ++i) {
        if (inside(xi1(i)) && inside(xi2(j))) visit(i, j, xi1(i), xi2(j), f);
      }
    }
  }
}

}  // namespace

Point current_point(const Discretisation& space, const VectorXd& unknowns, int node) {
  Point x = space.node_points()[node];
  for (int c = 0; c < 2; ++c) {
    const int unknown = space.displacement(node, c);
    if (unknown >= 0) x(c) += unknowns(unknown);
  }
  return x;
}

Contour contour(const Discretisation& space, const VectorXd& unknowns) {
  Contour curve;
  for (const BoundaryEdge& edge : space.surface()) {
    curve.pieces.push_back(
        nodal_field(edge.nodes, [&](int node, int c) { return current_point(space, unknowns, node)(c); }));
  }
  // Round-off must not put a pole beyond the axis.
  curve.pieces.front()(0, 1) = 0;
  curve.pieces.back()(curve.pieces.back().rows() - 1, 1) = 0;
  return curve;
}

SurfaceState surface_state(const Discretisation& space, const VectorXd& unknowns, int per_edge, double rest_stretch) {
  const ReferenceElement<2>& reference = space.reference();
  const VectorXd at = VectorXd::LinSpaced(per_edge, 0, 1);
  const MatrixXd value = reference.lagrange(at), slope = reference.lagrange_derivative(at);
  const MatrixXd second = slope * reference.lagrange_derivative(reference.nodes_1d);
  const int points = int(space.surface().size()) * per_edge;
  SurfaceState state;
  state.angle.resize(points);
  for (auto* field : {&state.point, &state.stretch, &state.curvature}) field->resize(points, 2);
  int i = 0;
  for (const BoundaryEdge& edge : space.surface()) {
    const auto now = nodal_field(edge.nodes, [&](int n, int c) { return current_point(space, unknowns, n)(c); });
    const auto rest = nodal_field(edge.nodes, [&](int n, int c) { return space.node_points()[n](c); });
    const Eigen::MatrixX2d x = value * now, x_t = slope * now, x_tt = second * now, X = value * rest,
                           X_t = slope * rest;
    for (int q = 0; q < per_edge; ++q, ++i) {
      const Meridian<double> here{x_t(q, 0), x_t(q, 1), x_tt(q, 0), x_tt(q, 1), x(q, 1)};
      const auto [along, around] = here.curvatures();
      const SurfaceReference at_rest = SurfaceReference{X_t(q, 0), X_t(q, 1), X(q, 1)}.at_rest(rest_stretch);
      const double stretch = here.speed() / at_rest.speed();
      const bool pole = X(q, 1) < 1e-9;  // where both directions are equal
      state.angle(i) = std::atan2(X(q, 1), X(q, 0));
      state.point.row(i) = x.row(q);
      state.stretch.row(i) << stretch, pole ? stretch : x(q, 1) / at_rest.r;
      state.curvature.row(i) << along, pole ? along : around;
    }
  }
  return state;
}

Eigen::MatrixX2d surface_tensions(const Cortex& cortex, const SurfaceState& state) {
  Eigen::MatrixX2d tensions(state.stretch.rows(), 2);
  for (int i = 0; i < tensions.rows(); ++i) {
    const auto T = principal_tensions(cortex, state.stretch(i, 0), state.stretch(i, 1));
    tensions.row(i) << T[0], T[1];
  }
  return tensions;
}

double min_biot_ratio(const SurfaceState& state) { return biot_ratios(state).minCoeff(); }

VectorXd biot_ratios(const SurfaceState& state) {
  // Incompressible: the normal stretch is 1 / (meridional hoop).
  return state.stretch.col(0).array().square() * state.stretch.col(1).array();
}

double least_along(const SurfaceState& state, const VectorXd& values) {
  Eigen::Index i = 0;
  const double least = values.minCoeff(&i);
  if (i == 0 || i + 1 == values.size()) return least;
  // Where edges meet there are two points.
  const bool is_inside = state.angle(i - 1) < state.angle(i) - 1e-9 && state.angle(i) < state.angle(i + 1) - 1e-9;
  return is_inside ? vertex(values(i - 1), least, values(i + 1)) : least;
}

double stretch_change(const Discretisation& space, const VectorXd& from, const VectorXd& to) {
  const int per_edge = 2 * space.reference().degree();
  const Eigen::ArrayXd a = surface_state(space, from, per_edge).stretch.col(0);
  const Eigen::ArrayXd b = surface_state(space, to, per_edge).stretch.col(0);
  return ((b - a) / b).abs().maxCoeff();
}

double end_pressure(const Discretisation& space, const VectorXd& unknowns, ChannelEnd end) {
  const ReferenceElement<2>& reference = space.reference();
  const ChannelGeometry& geometry = space.mesh().geometry();
  const Block block = end == ChannelEnd::upstream ? Block::upstream : Block::downstream;
  const double plane = (geometry.half_length() - geometry.box()) / (geometry.end() - geometry.box());
  double force = 0, area = 0;
  // Pressures of the elements on both sides.
  for (int e = 0; e < int(space.elements().size()); ++e) {
    const MeshElement& element = space.mesh().elements()[e];
    const auto side = std::ranges::find_if(element.outward, [&](double o) { return std::abs(o - plane) < 1e-9; });
    if (element.block != block || side == element.outward.end()) continue;
    const double at = side == element.outward.begin() ? 0 : 1, width = element.along[1] - element.along[0];
    for (int q = 0; q < reference.points_1d.size(); ++q) {
      const double along = reference.points_1d(q);
      const VectorXd modes = reference.pressure_modes(element.outward_first ? Point(at, along) : Point(along, at));
      double p = 0;
      for (int k = 0; k < modes.size(); ++k) p += modes(k) * unknowns(space.pressure(e, k));
      const double weight = reference.weights_1d(q) * width * (element.along[0] + along * width);
      force += p * weight;
      area += weight;
    }
  }
  return force / area;
}

double flow_rate(const Discretisation& space, const VectorXd& unknowns) {
  if (!space.has_open_inlet()) return 1;
  const ReferenceElement<2>& reference = space.reference();
  const MatrixXd value = reference.lagrange(reference.points_1d);
  double rate = unknowns(space.cell_velocity());
  for (const BoundaryEdge& edge : space.inlet()) {
    const auto point = nodal_field(edge.nodes, [&](int node, int c) { return space.node_points()[node](c); });
    const auto w = nodal_field(edge.nodes, [&](int node, int c) { return space.velocity(node, c).value(unknowns); });
    const double width = point.col(1).maxCoeff() - point.col(1).minCoeff();
    const VectorXd r = value * point.col(1), flux = value * w.col(0);
    rate += 2 * width * (reference.weights_1d.array() * r.array() * flux.array()).sum();
  }
  return rate;
}

double largest_displacement(const Discretisation& space, const VectorXd& unknowns) {
  double largest = 0;
  for (int node = 0; node < space.nodes().count; ++node) {
    for (int c = 0; c < 2; ++c) {
      const int unknown = space.displacement(node, c);
      if (unknown >= 0) largest = std::max(largest, std::abs(unknowns(unknown)));
    }
  }
  return largest;
}

void scale_displacement(const Discretisation& space, double factor, VectorXd& unknowns) {
  for (int i = 0; i < 2 * space.nodes().count; ++i) {
    const int unknown = space.displacement(i / 2, i % 2);
    if (unknown >= 0) unknowns(unknown) *= factor;
  }
}

VectorXd transfer(const Discretisation& from, const VectorXd& unknowns, const Discretisation& to) {
  std::vector<ElementFields> source;
  for (int f = 0; f < int(from.elements().size()); ++f) source.push_back(element_fields(from, unknowns, f));
  const ReferenceElement<2>& reference = to.reference();
  const int n = int(reference.nodes_1d.size()), m = int(reference.points_1d.size());
  VectorXd target = VectorXd::Zero(to.unknowns());
  target(to.cell_velocity()) = unknowns(from.cell_velocity());
  if (to.inner_pressure() >= 0) target(to.inner_pressure()) = unknowns(from.inner_pressure());
  for (int e = 0; e < int(to.elements().size()); ++e) {
    const MeshElement& self = to.mesh().elements()[e];
    const auto& nodes = to.nodes().of_element[e];
    locate(from.mesh(), self, reference.nodes_1d, [&](int i, int j, double xi1, double xi2, int f) {
      const int node = nodes[j * n + i];
      for (int c = 0; c < 2; ++c) {
        const int unknown = to.elements()[e].liquid ? to.velocity(node, c).unknown : to.displacement(node, c);
        if (unknown < 0 || unknown == to.cell_velocity()) continue;
        target(unknown) = from.reference().interpolate(source[f].vector.col(c), Point(xi1, xi2));
      }
    });
    if (to.elements()[e].is_empty()) continue;
    VectorXd pressure(m * m);
    locate(from.mesh(), self, reference.points_1d, [&](int i, int j, double xi1, double xi2, int f) {
      pressure(j * m + i) = from.reference().pressure_modes(Point(xi1, xi2)).dot(source[f].pressure);
    });
    // The modes are orthonormal: projection is a product.
    const VectorXd modes =
        reference.pressure.value.transpose() * (reference.weights.array() * pressure.array()).matrix();
    for (int k = 0; k < modes.size(); ++k) target(to.pressure(e, k)) = modes(k);
  }
  return target;
}

std::vector<Point> transferred_points(const Discretisation& from, const Discretisation& to) {
  const VectorXd &s = from.reference().nodes_1d, &t = to.reference().nodes_1d;
  const int n = int(t.size()), m = int(s.size());
  const double scale = to.mesh().geometry().radius() / from.mesh().geometry().radius();
  std::vector<MatrixXd> moved;
  for (int f = 0; f < int(from.elements().size()); ++f) {
    const auto& nodes = from.nodes().of_element[f];
    MatrixXd& of_nodes = moved.emplace_back(m * m, 2);
    for (int k = 0; k < m * m; ++k) {
      const Point at_first = from.mesh().elements()[f].map(from.mesh().geometry(), s(k % m), s(k / m));
      of_nodes.row(k) = scale * (from.node_points()[nodes[k]] - at_first).transpose();
    }
  }
  std::vector<Point> points = to.node_points();
  for (int e = 0; e < int(to.elements().size()); ++e) {
    if (!to.elements()[e].liquid) continue;
    const MeshElement& self = to.mesh().elements()[e];
    locate(from.mesh(), self, t, [&](int i, int j, double xi1, double xi2, int f) {
      const int node = to.nodes().of_element[e][j * n + i];
      if (to.displacement(node, 0) >= 0) return;
      points[node] = self.map(to.mesh().geometry(), t(i), t(j));
      for (int c = 0; c < 2; ++c) points[node](c) += from.reference().interpolate(moved[f].col(c), Point(xi1, xi2));
    });
  }
  return points;
}

}  // namespace rheocyte
