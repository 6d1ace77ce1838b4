#include "fem/discretisation.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "laws/developed_flow.h"

namespace rheocyte {
namespace {

constexpr double tiny = 1e-10;

/// How much of the surface's axial displacement the wall's points take over: nearly all of it above the cell, where
/// soft cells drag their surface far to the rear, nothing at the corner spokes.
double wall_slide(double along) { return 1 - std::pow(2 * along - 1, 4); }

/// Local nodes of the edge outward = side (0 or 1), in the order of `along`.
std::vector<int> edge_nodes(const MeshElement& element, const std::vector<int>& nodes, int degree, int side) {
  std::vector<int> edge;
  for (int k = 0; k <= degree; ++k) {
    const int i = element.outward_first ? side * degree : k, j = element.outward_first ? k : side * degree;
    edge.push_back(nodes[j * (degree + 1) + i]);
  }
  return edge;
}

}  // namespace

Discretisation::Discretisation(const ChannelMesh& mesh, int degree, const Liquid& liquid, Interior interior,
                               Drive drive)
    : mesh_(&mesh),
      liquid_(liquid),
      interior_(interior),
      open_inlet_(drive != Drive::rate),
      reference_(degree, points_for(degree, interior)),
      nodes_(mesh.number_nodes(degree)),
      points_(nodes_.count) {
  const VectorXd& s = reference_.nodes_1d;
  for (std::size_t e = 0; e < mesh.elements().size(); ++e) {
    for (int k = 0; k < reference_.nodes(); ++k) {
      points_[nodes_.of_element[e][k]] =
          mesh.elements()[e].map(mesh.geometry(), s(k % (degree + 1)), s(k / (degree + 1)));
    }
  }
  straight_points_ = points_;
  number_unknowns(flag_nodes());
  find_edges();
  set_inflow();
  const auto node_values = MatrixXd::Identity(reference_.nodes(), reference_.nodes());
  const auto positions = std::make_shared<PositionShapes>(
      PositionShapes{{reference_.shape, reference_.shape}, {node_values, node_values}});
  for (std::size_t e = 0; e < mesh.elements().size(); ++e) {
    elements_.push_back(is_cell(mesh.elements()[e].block) ? cell_element(int(e), positions) : liquid_element(int(e)));
  }
}

std::vector<Discretisation::NodeFlags> Discretisation::flag_nodes() const {
  std::vector<NodeFlags> flags(nodes_.count);
  const double end = mesh_->geometry().end();
  for (int i = 0; i < nodes_.count; ++i) {
    const Point& x = points_[i];
    flags[i].axis = x(1) < tiny;
    flags[i].wall = x(1) > 1 - tiny;
    flags[i].inlet = x(0) < -end + tiny;
    flags[i].outlet = x(0) > end - tiny;
  }
  for (std::size_t e = 0; e < nodes_.of_element.size(); ++e) {
    const bool cell = is_cell(mesh_->elements()[e].block);
    for (int k = 0; k < reference_.nodes(); ++k) {
      NodeFlags& f = flags[nodes_.of_element[e][k]];
      (cell ? f.cell : f.liquid) = true;
    }
  }
  for (NodeFlags& f : flags) f.surface = f.cell && f.liquid;
  return flags;
}

void Discretisation::number_unknowns(const std::vector<NodeFlags>& flags) {
  const int modes = reference_.pressures(), elements = int(nodes_.of_element.size());
  displacement_.assign(2 * nodes_.count, -1);
  velocity_.assign(2 * nodes_.count, Slot{});
  pressure_.assign(elements * modes, -1);
  for (int i = 0; i < nodes_.count; ++i) {
    const NodeFlags& f = flags[i];
    if (f.cell) {
      if (interior_ == Interior::liquid && !f.surface) continue;
      displacement_[2 * i] = unknowns_++;
      if (!f.axis) displacement_[2 * i + 1] = unknowns_++;
    } else {
      if (!f.wall && (!f.inlet || open_inlet_)) velocity_[2 * i].unknown = unknowns_++;
      if (!f.wall && !f.inlet && !f.outlet && !f.axis) velocity_[2 * i + 1].unknown = unknowns_++;
    }
  }
  for (int e = 0; e < elements; ++e) {
    if (interior_ == Interior::liquid && is_cell(mesh_->elements()[e].block)) continue;
    for (int k = 0; k < modes; ++k) pressure_[e * modes + k] = unknowns_++;
  }
  cell_velocity_ = unknowns_++;
  if (interior_ == Interior::liquid) inner_pressure_ = unknowns_++;
  // Walls and inlet move backwards past the cell.
  for (int i = 0; i < nodes_.count; ++i) {
    if (flags[i].cell || !(flags[i].wall || (flags[i].inlet && !open_inlet_))) continue;
    velocity_[2 * i] = {cell_velocity_, -1, 0};
  }
}

void Discretisation::set_inflow() {
  double radius = 0;
  for (const BoundaryEdge& edge : inlet_) {
    for (const int node : edge.nodes) radius = std::max(radius, points_[node](1));
  }
  const Liquid liquid = in_units_of_rate(liquid_, 1 / (radius * radius * radius));
  for (const BoundaryEdge& edge : inlet_) {
    for (const int node : edge.nodes) {
      const double r = points_[node](1);
      if (open_inlet_ || r == radius) continue;
      velocity_[2 * node].constant = undisturbed_velocity(liquid, r / radius) / (radius * radius);
    }
  }
}

VectorXd Discretisation::wall_motion(const std::function<double(double)>& wall, const VectorXd& unknowns) const {
  VectorXd outward = VectorXd::Zero(nodes_.count);
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    if (!elements_[e].liquid) continue;
    const MeshElement& self = mesh_->elements()[e];
    for (int k = 0; k < reference_.nodes(); ++k) {
      const int node = nodes_.of_element[e][k], p = reference_.degree(), i = k % (p + 1), j = k / (p + 1);
      const auto [out, along] = self.parameters(reference_.nodes_1d(i), reference_.nodes_1d(j));
      // Where the node is, and its fraction of the motion, which grows with r: so it never passes one above it.
      double x = straight_points_[node](0), fraction = straight_points_[node](1);
      if (has_spokes(self.block)) {
        const int foot = elements_[e].columns[self.outward_first ? j : i].unknown;
        if (foot >= 0) x += elements_[e].position->at_nodes[0](k, self.outward_first ? j : i) * unknowns(foot);
        fraction = self.block == Block::top ? out : out * along;
      }
      outward(node) = fraction * (wall(x) - 1);
    }
  }
  return outward;
}

void Discretisation::move_nodes(const VectorXd& outward) {
  for (int i = 0; i < nodes_.count; ++i) points_[i](1) = straight_points_[i](1) + outward(i);
  set_inflow();
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    ElementUnknowns& element = elements_[e];
    if (!element.liquid) continue;
    element.undeformed = undeformed_maps(int(e));
    for (int k = 0; k < reference_.nodes(); ++k) {
      Slot& slot = element.columns[2 * element.position_columns + k];
      if (slot.unknown == cell_velocity_) slot = velocity(nodes_.of_element[e][k], 0);
    }
  }
}

void Discretisation::set_points(const std::vector<Point>& points) {
  points_ = straight_points_ = points;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    if (elements_[e].liquid) replace_maps(elements_[e].undeformed, undeformed_maps(int(e)));
  }
}

void Discretisation::find_edges() {
  const auto collect = [this](Block block, int side, bool reversed) {
    std::vector<BoundaryEdge> edges;
    for (std::size_t e = 0; e < mesh_->elements().size(); ++e) {
      const MeshElement& element = mesh_->elements()[e];
      if (element.block != block || element.outward[side] != side) continue;
      auto nodes = edge_nodes(element, nodes_.of_element[e], reference_.degree(), side);
      if (reversed) std::reverse(nodes.begin(), nodes.end());
      edges.push_back({int(e), nodes});
    }
    if (reversed) std::reverse(edges.begin(), edges.end());
    return edges;
  };
  for (const Block block : {Block::ring_front, Block::ring_top, Block::ring_rear}) {
    const auto edges = collect(block, 1, block == Block::ring_rear);
    surface_.insert(surface_.end(), edges.begin(), edges.end());
  }
  inlet_ = collect(Block::upstream, 1, false);
  outlet_ = collect(Block::downstream, 1, false);
}

std::vector<PointMap<double, 2>> Discretisation::undeformed_maps(int element) const {
  const int n = reference_.nodes();
  Eigen::MatrixX2d X(n, 2);
  for (int k = 0; k < n; ++k) X.row(k) = points_[nodes_.of_element[element][k]].transpose();
  const VectorXd r = reference_.shape.value * X.col(1);
  const Eigen::MatrixX2d x1 = reference_.shape.slope[0] * X, x2 = reference_.shape.slope[1] * X;
  std::vector<PointMap<double, 2>> maps;
  for (int q = 0; q < reference_.points(); ++q) {
    MapFields<double, 2> map;
    map.G = {x1(q, 0), x2(q, 0), x1(q, 1), x2(q, 1)};
    map.r = r(q);
    maps.emplace_back(map);
  }
  return maps;
}

ElementUnknowns Discretisation::cell_element(int element, const std::shared_ptr<const PositionShapes>& position) const {
  const auto& nodes = nodes_.of_element[element];
  ElementUnknowns unknowns;
  if (interior_ == Interior::liquid) return unknowns;
  unknowns.position_columns = reference_.nodes();
  unknowns.position = position;
  unknowns.undeformed = undeformed_maps(element);
  for (int c = 0; c < 2; ++c) {
    for (const int node : nodes) unknowns.columns.push_back({displacement(node, c)});
  }
  for (int k = 0; k < reference_.pressures(); ++k) unknowns.columns.push_back({pressure(element, k)});
  for (const Slot& slot : unknowns.columns) unknowns.rows.push_back(slot.unknown);
  return unknowns;
}

ElementUnknowns Discretisation::liquid_element(int element) const {
  const auto& nodes = nodes_.of_element[element];
  ElementUnknowns unknowns;
  unknowns.liquid = true;
  unknowns.undeformed = undeformed_maps(element);
  if (has_spokes(mesh_->elements()[element].block)) add_spokes(element, unknowns);
  for (int c = 0; c < 2; ++c) {
    for (const int node : nodes) {
      // On the surface the relative velocity vanishes, and the liquid's momentum is added to the cell's equation.
      const Slot slot = velocity(node, c);
      const bool surface = displacement(node, 0) >= 0;
      unknowns.columns.push_back(surface ? Slot{} : slot);
      const bool own_equation = slot.unknown != cell_velocity_;
      unknowns.rows.push_back(surface ? displacement(node, c) : own_equation ? slot.unknown : -1);
    }
  }
  for (int k = 0; k < reference_.pressures(); ++k) {
    unknowns.columns.push_back({pressure(element, k)});
    unknowns.rows.push_back(pressure(element, k));
  }
  return unknowns;
}

void Discretisation::add_spokes(int element, ElementUnknowns& unknowns) const {
  const MeshElement& self = mesh_->elements()[element];
  const auto foot = std::find_if(mesh_->elements().begin(), mesh_->elements().end(), [&](const MeshElement& other) {
    return other.block == self.block && other.along == self.along && other.outward[0] == 0;
  });
  assert(foot != mesh_->elements().end());
  const int p = reference_.degree();
  const auto surface = edge_nodes(*foot, nodes_.of_element[foot - mesh_->elements().begin()], p, 0);

  // D_r = (1 - s) U_r, D_x = (1 - s (1 - slide)) U_x: both are linear outward, so their nodal values say everything.
  std::array<MatrixXd, 2> extension;
  extension.fill(MatrixXd::Zero(reference_.nodes(), p + 1));
  for (int k = 0; k < reference_.nodes(); ++k) {
    const int i = k % (p + 1), j = k / (p + 1);
    const auto [outward, along] = self.parameters(reference_.nodes_1d(i), reference_.nodes_1d(j));
    const double slide = self.block == Block::top ? wall_slide(along) : 0;
    extension[0](k, self.outward_first ? j : i) = 1 - outward * (1 - slide);
    extension[1](k, self.outward_first ? j : i) = 1 - outward;
  }
  const ShapeTable<2>& shape = reference_.shape;
  unknowns.position_columns = p + 1;
  const auto position = std::make_shared<PositionShapes>();
  position->at_nodes = extension;
  for (int c = 0; c < 2; ++c) {
    position->at_points[c].value = shape.value * extension[c];
    for (int k = 0; k < 2; ++k) position->at_points[c].slope[k] = shape.slope[k] * extension[c];
  }
  unknowns.position = position;
  for (int c = 0; c < 2; ++c) {
    for (const int node : surface) unknowns.columns.push_back({displacement(node, c)});
  }
}

}  // namespace rheocyte
