#include "fem/fit_liquid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fem/element_integrals.h"
#include "fem/liquid_mesh.h"
#include "fem/observe.h"
#include "fem/requested_elements.h"

namespace rheocyte {
namespace {

/// Of the mesh that is fitted: it need not have all wiggles of a fine one's surface.
constexpr int max_degree = 6;
constexpr double same_line = 1e-10;

/// Nodes of the channel's ends stay, those on the axis and at the wall slide.
LiquidMesh<2> liquid_mesh(const Discretisation& space, const VectorXd& unknowns, const ReferenceElement<2>& reference) {
  const ChannelMesh& mesh = space.mesh();
  const VectorXd& s = reference.nodes_1d;
  const int n = int(s.size());
  std::vector<LiquidElement> elements;
  for (int e = 0; e < int(space.elements().size()); ++e) {
    if (!space.elements()[e].liquid) continue;
    MatrixXd rest(n * n, 2);
    for (int k = 0; k < n * n; ++k)
      rest.row(k) = mesh.elements()[e].map(mesh.geometry(), s(k % n), s(k / n)).transpose();
    elements.push_back({e, points_of_nodes(space, e, unknowns), std::move(rest)});
  }
  LiquidMesh<2> liquid(space.reference(), reference, mesh.number_nodes(reference.degree()), std::move(elements));
  using Component = LiquidMesh<2>::Component;
  liquid.number_components([end = mesh.geometry().end()](const Point& x) -> std::array<Component, 2> {
    if (std::abs(x(0)) > end - same_line) return {Component::held, Component::held};
    return {Component::free, x(1) > same_line && x(1) < 1 - same_line ? Component::free : Component::held};
  });
  return liquid;
}

ReferenceElement<2> fitted_reference(const Discretisation& space) {
  return ReferenceElement<2>(std::min(space.reference().degree(), max_degree));
}

/// Along the top, from front to rear.
RequestedElements requested_on_top(const Discretisation& space, const VectorXd& unknowns) {
  constexpr int points_per_edge = 33;
  const ChannelGeometry& geometry = space.mesh().geometry();
  const double first = geometry.angle(Sector::top, 0), angle = geometry.angle(Sector::top, 1) - first;
  const SurfaceState surface = surface_state(space, unknowns, points_per_edge);
  std::vector<LinePoint> line;
  for (Eigen::Index i = 0; i < surface.angle.size(); ++i) {
    const double here = (surface.angle(i) - first) / angle;
    if (here < -same_line || here > 1 + same_line || (!line.empty() && here <= line.back().place)) continue;
    line.push_back({here, angle, surface.stretch(i, 0), geometry.radius() * surface.curvature(i, 0)});
  }
  return RequestedElements({line});
}

}  // namespace

SurfaceBreaks fitted_breaks(const Discretisation& space, const VectorXd& unknowns, double evenly) {
  SurfaceBreaks breaks = space.mesh().breaks();
  if (breaks.axis.empty()) breaks.axis = breaks.top;
  breaks.top = requested_on_top(space, unknowns).moved(std::move(breaks.top), evenly);
  return breaks;
}

double surface_evenness(const Discretisation& space, const VectorXd& unknowns) {
  return requested_on_top(space, unknowns).evenness(space.mesh().breaks().top);
}

double liquid_mesh_quality(const Discretisation& space, const VectorXd& unknowns) {
  const ReferenceElement<2> reference = fitted_reference(space);
  return liquid_mesh(space, unknowns, reference).quality();
}

std::vector<Point> fitted_points(const Discretisation& space, const VectorXd& unknowns) {
  const ReferenceElement<2> reference = fitted_reference(space);
  std::vector<Point> points = space.node_points();
  liquid_mesh(space, unknowns, reference).fit([&](int e, const MatrixXd& moves) {
    const auto& nodes = space.nodes().of_element[e];
    for (int k = 0; k < int(nodes.size()); ++k) {
      if (space.displacement(nodes[k], 0) < 0)
        points[nodes[k]] = space.node_points()[nodes[k]] + moves.row(k).transpose();
    }
  });
  return points;
}

}  // namespace rheocyte
