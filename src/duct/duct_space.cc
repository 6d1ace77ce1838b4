#include "duct/duct_space.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "shape/curve.h"

namespace rheocyte {

DuctSpace::DuctSpace(const DuctMesh& mesh, Interior interior, int degree)
    : mesh_(mesh),
      interior_(interior),
      reference_(degree, points_for(degree, interior)),
      section_(mesh.geometry(), degree, mesh.symmetry(), mesh.subdivision().across),
      nodes_(mesh.number_nodes(degree)),
      points_(nodes_.count),
      places_(nodes_.count) {
  const VectorXd& s = reference_.nodes_1d;
  const int n = degree + 1;
  for (int e = 0; e < int(mesh.elements().size()); ++e) {
    const DuctElement& self = mesh.elements()[e];
    for (int k = 0; k < reference_.nodes(); ++k) {
      const Eigen::Vector3d xi(s(k % n), s(k / n % n), s(k / (n * n)));
      const int node = nodes_.of_element[e][k];
      points_[node] = mesh.point(e, xi);
      if (!self.in_cell()) places_[node] = {self.part, self.on_cube(xi(0), xi(1), xi(2)), self.outward_at(xi(2))};
    }
  }
  straight_points_ = points_;
  find_fixed_nodes();
}

DuctSpace::DuctSpace(const DuctMesh& mesh, int degree, const Liquid& liquid, Drive drive, Interior interior)
    : DuctSpace(mesh, interior, degree) {
  liquid_ = liquid;
  open_inlet_ = drive != Drive::rate;
  const DuctFlow inflow = open_inlet_ ? DuctFlow{} : section_.flow(liquid);
  number_unknowns([&](const Eigen::Vector2d& at) {
    return mesh.geometry().is_wall({0, at(0), at(1)}) ? 0.0 : inflow.velocity(section_.node_at(at));
  });
}

DuctSpace::DuctSpace(const DuctMesh& mesh, int degree, const GivenFlow& flow)
    : DuctSpace(mesh, Interior::elastic, degree) {
  given_flow_ = true;
  number_unknowns(flow.velocity);
}

VectorXd DuctSpace::wall_motion(const std::function<double(double)>& wall, const VectorXd& unknowns) const {
  VectorXd outward = VectorXd::Zero(nodes_.count);
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const HexahedronUnknowns& self = elements_[e];
    for (int k = 0; k < reference_.nodes() && self.liquid; ++k) {
      const int node = nodes_.of_element[e][k];
      const double slide = self.moves ? self.displacement[k].value(unknowns) : 0;
      outward(node) = wall(straight_points_[node](0) + slide) - 1;
    }
  }
  return outward;
}

void DuctSpace::move_nodes(const VectorXd& outward, double aside) {
  aside_ = aside;
  for (int i = 0; i < nodes_.count; ++i) {
    const auto& [part, cube, way] = places_[i];
    if (part == Part::layers || part == Part::end)
      points_[i].tail<2>() = mesh_.geometry().across(part, cube, way, 1 + outward(i), aside);
  }
  if (!open_inlet_ && !given_flow_) set_inflow(outward);
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    HexahedronUnknowns& self = elements_[e];
    if (!self.liquid) continue;
    self.undeformed = undeformed_maps(int(e));
    for (int i = 0; i < 3 * reference_.nodes(); ++i)
      self.velocity[i] = velocity(nodes_.of_element[e][i % reference_.nodes()], i / reference_.nodes());
  }
}

void DuctSpace::set_points(const std::vector<DuctPoint>& points) {
  points_ = straight_points_ = points;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    if (elements_[e].liquid) replace_maps(elements_[e].undeformed, undeformed_maps(int(e)));
  }
}

VectorXd DuctSpace::inflow_at(double stretch) const {
  const DuctGeometry& geometry = mesh_.geometry();
  if (geometry.section() == Section::tube) {
    const double area = stretch * stretch;
    return section_.flow(in_units_of_rate(liquid_, 1 / (area * stretch))).velocity / area;
  }
  DuctShape wider = geometry.shape();
  wider.section = Section::rectangle;
  (wider.narrows_in_height ? wider.extent.height : wider.extent.width) *= stretch;
  if (!wider.narrows_in_height) wider.offset *= stretch;
  // Its nodes have the numbers of those of the straight section.
  const CrossSection inlet(DuctGeometry(wider), reference_.degree(), mesh_.symmetry(), mesh_.subdivision().across);
  return inlet.flow(in_units_of_rate(liquid_, 1 / stretch)).velocity / stretch;
}

void DuctSpace::set_inflow(const VectorXd& outward) {
  const DuctShape& shape = mesh_.geometry().shape();
  const bool is_tube = shape.section == Section::tube;
  const int narrowing = shape.narrows_in_height ? 2 : 1;
  const double end = mesh_.geometry().end(), slope = inlet_slope(outward);
  VectorXd inflow;
  for (int i = 0; i < nodes_.count; ++i) {
    if (straight_points_[i](0) > -end + same_place || mesh_.geometry().is_wall(straight_points_[i])) continue;
    if (inflow.size() == 0) inflow = inflow_at(1 + outward(i));
    const double velocity = inflow(section_.node_at(straight_points_[i].tail<2>()));
    velocity_[3 * i].constant = velocity;
    for (int c = 1; c < 3; ++c)
      if (is_tube || c == narrowing) velocity_[3 * i + c].constant = slope * velocity * straight_points_[i](c);
  }
}

double DuctSpace::inlet_slope(const VectorXd& outward) const {
  const int p = reference_.degree(), on_face = (p + 1) * (p + 1);
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const DuctElement& element = mesh_.elements()[e];
    const bool is_last = element.outward[1] == mesh_.geometry().last_outward();
    if (element.part != Part::end || element.face != Face::rear || !is_last) continue;
    const auto& nodes = nodes_.of_element[e];
    VectorXd along(p + 1);
    for (int k = 0; k <= p; ++k) along(k) = outward(nodes[k * on_face]);
    const double length = straight_points_[nodes[p * on_face]](0) - straight_points_[nodes[0]](0);
    return (lagrange_slopes(p, VectorXd::Ones(1)) * along)(0) / length;
  }
  assert(false);
  return 0;
}

/// The node on the cell's axis, or on its surface, that is nearest to its middle, and the one at its front pole.
void DuctSpace::find_fixed_nodes() {
  const double radius = mesh_.geometry().radius();
  double nearest = radius;
  const Eigen::Vector2d centre(mesh_.geometry().shape().offset, 0);
  for (int i = 0; i < nodes_.count; ++i) {
    const double off = (points_[i].tail<2>() - centre).norm();
    if (off < same_place && std::abs(points_[i](0) - radius) < same_place) fixed_pole_ = i;
    const bool is_candidate = interior_ == Interior::liquid
                                  ? std::abs(std::hypot(points_[i](0), off) - radius) < same_place
                                  : off < same_place;
    if (!is_candidate || std::abs(points_[i](0)) >= nearest - same_place) continue;
    fixed_node_ = i;
    nearest = std::abs(points_[i](0));
  }
}

std::vector<DuctSpace::NodeFlags> DuctSpace::flag_nodes() const {
  std::vector<NodeFlags> flags(nodes_.count);
  const double end = mesh_.geometry().end();
  for (int i = 0; i < nodes_.count; ++i) {
    const DuctPoint& x = points_[i];
    flags[i].across = across_at(mesh_.symmetry(), x);
    flags[i].wall = mesh_.geometry().is_wall(x);
    flags[i].inlet = x(0) < -end + same_place;
    flags[i].outlet = x(0) > end - same_place;
  }
  for (std::size_t e = 0; e < nodes_.of_element.size(); ++e) {
    for (const int node : nodes_.of_element[e])
      (mesh_.elements()[e].in_cell() ? flags[node].cell : flags[node].liquid) = true;
  }
  return flags;
}

void DuctSpace::number_unknowns(const std::function<double(const Eigen::Vector2d&)>& inflow) {
  const std::vector<NodeFlags> flags = flag_nodes();
  displacement_.assign(3 * nodes_.count, -1);
  velocity_.assign(3 * nodes_.count, Slot{});
  cell_velocity_ = unknowns_++;
  if (turns()) {
    drift_ = unknowns_++;
    spin_ = unknowns_++;
  }
  for (int i = 0; i < nodes_.count; ++i) {
    const NodeFlags& f = flags[i];
    // Numbers of the components y and z of a node that may move across the flow.
    const auto number_across = [&](bool holds_y, auto&& at) {
      if (!holds_y) at(1) = unknowns_++;
      if (!f.across.holds_z) at(2) = f.across.ties ? at(1) : unknowns_++;
    };
    if (f.cell && !f.liquid && interior_ == Interior::liquid) continue;
    if (f.cell) {
      if (i != fixed_node_) displacement_[3 * i] = unknowns_++;
      const bool is_held = f.across.holds_y || (turns() && (i == fixed_node_ || i == fixed_pole_));
      number_across(is_held, [&](int c) -> int& { return displacement_[3 * i + c]; });
      if (!(turns() && f.liquid)) continue;
    }
    // What does not move across the duct moves backwards past the cell, and so do walls and inlet along it.
    const bool fixed = f.wall || (f.inlet && !open_inlet_);
    if (turns() && (fixed || f.inlet || f.outlet)) velocity_[3 * i + 1] = {drift_, -1, 0};
    if (fixed) {
      velocity_[3 * i] = {cell_velocity_, -1, inflow(points_[i].tail<2>())};
      continue;
    }
    velocity_[3 * i].unknown = unknowns_++;
    if (!f.outlet && !f.inlet)
      number_across(f.across.holds_y, [&](int c) -> int& { return velocity_[3 * i + c].unknown; });
  }
  const int modes = reference_.pressures();
  pressure_.assign(nodes_.of_element.size() * std::size_t(modes), -1);
  for (int k = 0; k < int(pressure_.size()); ++k) {
    if (interior_ != Interior::liquid || !mesh_.elements()[k / modes].in_cell()) pressure_[k] = unknowns_++;
  }
  if (interior_ == Interior::liquid) inner_pressure_ = unknowns_++;
  for (int e = 0; e < int(mesh_.elements().size()); ++e) elements_.push_back(unknowns_of(e));
}

int DuctSpace::momentum_row(int node, int c) const {
  if (node == fixed_node_ && c == 0) return cell_velocity_;
  if (turns() && node == fixed_node_ && c == 1) return drift_;
  if (turns() && node == fixed_pole_ && c == 1) return spin_;
  return displacement(node, c);
}

std::vector<PointMap<double, 3>> DuctSpace::undeformed_maps(int element) const {
  const int n = reference_.nodes();
  Eigen::MatrixX3d X(n, 3);
  for (int k = 0; k < n; ++k) X.row(k) = points_[nodes_.of_element[element][k]].transpose();
  std::array<Eigen::MatrixX3d, 3> G;
  for (int k = 0; k < 3; ++k) G[k] = reference_.shape.slope[k] * X;
  std::vector<PointMap<double, 3>> maps;
  for (int q = 0; q < reference_.points(); ++q) {
    MapFields<double, 3> map;
    for (int i = 0; i < 9; ++i) map.G(i) = G[i / 3](q, i % 3);
    maps.emplace_back(map);
  }
  return maps;
}

/// In an elastic cell the nodes' own; along a spoke those of its foot on the surface, which die away outward
/// (docs/theory.md, eq:spokes), and in a liquid interior inward.
void DuctSpace::add_displacements(int element, HexahedronUnknowns& unknowns) const {
  const DuctElement& self = mesh_.elements()[element];
  const auto& nodes = nodes_.of_element[element];
  if (self.part == Part::end) return;
  unknowns.moves = true;
  const int p = reference_.degree(), n = p + 1;
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < reference_.nodes(); ++k) {
      const VectorXd& s = reference_.nodes_1d;
      if (self.in_cell()) {
        const bool follows = interior_ == Interior::liquid && self.part == Part::ring;
        unknowns.displacement.push_back(follows ? Slot{displacement(nodes[k % (n * n) + p * n * n], c), s(k / (n * n))}
                                                : Slot{displacement(nodes[k], c)});
        continue;
      }
      const double outward = self.outward_at(s(k / (n * n)));
      const double slide = c == 0 ? wall_slide(self.on_cube(s(k % n), s(k / n % n), 1)) : 0;
      const int foot = nodes_.of_element[self.foot][k % (n * n)];
      unknowns.displacement.push_back({displacement(foot, c), 1 - outward * (1 - slide)});
    }
  }
}

HexahedronUnknowns DuctSpace::unknowns_of(int element) const {
  const auto& nodes = nodes_.of_element[element];
  HexahedronUnknowns unknowns;
  unknowns.liquid = !mesh_.elements()[element].in_cell();
  unknowns.is_empty = !unknowns.liquid && interior_ == Interior::liquid;
  unknowns.undeformed = undeformed_maps(element);
  add_displacements(element, unknowns);
  for (int c = 0; c < 3; ++c) {
    for (const int node : nodes) {
      // On the surface the liquid's momentum is added to the cell's equation. The relative velocity vanishes there, or
      // is that of the turning surface.
      const bool in_cell = displacement(node, 0) >= 0 || node == fixed_node_;
      if (unknowns.liquid) unknowns.velocity.push_back(velocity(node, c));
      const int own = is_motion(velocity(node, c).unknown) ? -1 : velocity(node, c).unknown;
      unknowns.rows.push_back(unknowns.is_empty ? -1 : in_cell ? momentum_row(node, c) : own);
    }
  }
  for (int k = 0; k < reference_.pressures(); ++k) {
    // The first mode is the constant 1.
    unknowns.pressure.push_back({unknowns.is_empty && k == 0 ? inner_pressure_ : pressure(element, k)});
    unknowns.rows.push_back(pressure(element, k));
  }
  return unknowns;
}

}  // namespace rheocyte
