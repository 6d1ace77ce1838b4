#include "duct/fit_duct.h"

#include <algorithm>

#include "duct/duct_integrals.h"
#include "fem/liquid_mesh.h"

namespace rheocyte {
namespace {

/// Of the mesh that is fitted: a higher one costs more than it gains.
constexpr int max_fitted_degree = 2;

/// Of the nodes of an element at some degree, round the undeformed cell.
MatrixXd rest_places(const DuctMesh& mesh, int e, const VectorXd& s) {
  const int n = int(s.size());
  MatrixXd places(n * n * n, 3);
  for (int k = 0; k < places.rows(); ++k)
    places.row(k) = mesh.point(e, {s(k % n), s(k / n % n), s(k / (n * n))}).transpose();
  return places;
}

/// Nodes of the duct's ends stay, those at walls and in mirror planes slide.
LiquidMesh<3> liquid_mesh(const DuctSpace& space, const VectorXd& unknowns, const ReferenceElement<3>& reference) {
  const DuctMesh& mesh = space.mesh();
  std::vector<LiquidElement> elements;
  for (int e = 0; e < int(space.elements().size()); ++e) {
    if (space.elements()[e].liquid)
      elements.push_back({e, points_of_nodes(space, e, unknowns), rest_places(mesh, e, reference.nodes_1d)});
  }
  LiquidMesh<3> liquid(space.reference(), reference, mesh.number_nodes(reference.degree()), std::move(elements));
  using Component = LiquidMesh<3>::Component;
  const auto component = [](bool is_held) { return is_held ? Component::held : Component::free; };
  liquid.number_components([&](const DuctPoint& x) -> std::array<Component, 3> {
    const DuctGeometry& geometry = mesh.geometry();
    if (std::abs(x(0)) > geometry.end() - same_place) return {Component::held, Component::held, Component::held};
    const Across across = across_at(mesh.symmetry(), x);
    const bool is_tube = geometry.section() == Section::tube, is_wall = geometry.is_wall(x);
    const Extent& extent = geometry.shape().extent;
    const bool at_y = is_wall && (is_tube || std::abs(x(1)) > extent.width - same_place),
               at_z = is_wall && (is_tube || std::abs(x(2)) > extent.height - same_place);
    if (across.ties)
      return {Component::free, component(at_y || at_z), at_y || at_z ? Component::held : Component::tied};
    return {Component::free, component(across.holds_y || at_y), component(across.holds_z || at_z)};
  });
  return liquid;
}

ReferenceElement<3> fitted_reference(const DuctSpace& space) {
  return ReferenceElement<3>(std::min(space.reference().degree(), max_fitted_degree));
}

}  // namespace

double liquid_mesh_quality(const DuctSpace& space, const VectorXd& unknowns) {
  const ReferenceElement<3> reference = fitted_reference(space);
  return liquid_mesh(space, unknowns, reference).quality();
}

std::vector<DuctPoint> fitted_points(const DuctSpace& space, const VectorXd& unknowns) {
  const ReferenceElement<3> reference = fitted_reference(space);
  std::vector<DuctPoint> points = space.node_points();
  liquid_mesh(space, unknowns, reference).fit([&](int e, const MatrixXd& moves) {
    const auto& nodes = space.nodes().of_element[e];
    for (int k = 0; k < int(nodes.size()); ++k) {
      const bool is_of_cell = space.displacement(nodes[k], 0) >= 0 || nodes[k] == space.fixed_node();
      if (!is_of_cell) points[nodes[k]] = space.node_points()[nodes[k]] + moves.row(k).transpose();
    }
  });
  return points;
}

std::vector<DuctPoint> transferred_points(const DuctSpace& from, const DuctSpace& to) {
  const VectorXd& own = to.reference().nodes_1d;
  const MatrixXd basis = from.reference().lagrange(own);
  const double scale = to.mesh().geometry().radius() / from.mesh().geometry().radius();
  std::vector<DuctPoint> points = to.node_points();
  for (int e = 0; e < int(to.elements().size()); ++e) {
    if (!to.elements()[e].liquid) continue;
    const auto &nodes = from.nodes().of_element[e], &nodes_to = to.nodes().of_element[e];
    MatrixXd moves = -rest_places(from.mesh(), e, from.reference().nodes_1d);
    for (int k = 0; k < moves.rows(); ++k) moves.row(k) += from.node_points()[nodes[k]].transpose();
    const MatrixXd places = rest_places(to.mesh(), e, own) + scale * at_other_nodes<3>(basis, moves);
    for (int k = 0; k < places.rows(); ++k) {
      const bool is_of_cell = to.displacement(nodes_to[k], 0) >= 0 || nodes_to[k] == to.fixed_node();
      if (!is_of_cell) points[nodes_to[k]] = places.row(k).transpose();
    }
  }
  return points;
}

}  // namespace rheocyte
