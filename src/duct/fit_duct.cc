#include "duct/fit_duct.h"

#include <algorithm>
#include <cmath>
#include <ranges>

#include "duct/duct_integrals.h"
#include "duct/duct_silhouette.h"
#include "fem/liquid_mesh.h"
#include "fem/requested_elements.h"

namespace rheocyte {
namespace {

/// Of the mesh that is fitted: a higher one costs more than it gains.
constexpr int max_fitted_degree = 2;

/// Nodes of the duct's ends stay, those at walls and in mirror planes slide.
LiquidMesh<3> liquid_mesh(const DuctSpace& space, const VectorXd& unknowns, const ReferenceElement<3>& reference) {
  const DuctMesh& mesh = space.mesh();
  std::vector<LiquidElement> elements;
  for (int e = 0; e < int(space.elements().size()); ++e) {
    if (space.elements()[e].liquid)
      elements.push_back({e, points_of_nodes(space, e, unknowns), mesh.points(e, reference.nodes_1d)});
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

/// From front to rear, as parts of the way.
double place_of(double height) { return (1 - height) / 2; }
double height_at(double place) { return 1 - 2 * place; }

/// A meridian in a plane of symmetry, on the side.
std::vector<LinePoint> line_on_side(const DuctSpace& space, const VectorXd& unknowns, Camera camera) {
  const VectorXd along = VectorXd::LinSpaced(33, 0, 1);
  const DuctMeridian meridian = duct_meridian(space, unknowns, camera, along);
  const std::vector<double>& heights = space.mesh().side_breaks();
  const Eigen::Index pieces = Eigen::Index(heights.size()) - 1, points = along.size(),
                     before = (meridian.rest_angle.size() / points - pieces) / 2;
  std::vector<LinePoint> line;
  std::vector<double> angle;
  for (Eigen::Index i = 0; i < pieces * points; ++i) {
    if (i > 0 && i % points == 0) continue;
    const auto rear = std::size_t(pieces - 1 - i / points);
    const Eigen::Index row = before * points + i;
    line.push_back({place_of(std::lerp(heights[rear + 1], heights[rear], along(i % points))), 0,
                    meridian.stretch(row, 0), space.mesh().geometry().radius() * meridian.curvature(row, 0)});
    angle.push_back(meridian.rest_angle(row));
  }
  for (std::size_t i = 0; i < line.size(); ++i) {
    const std::size_t a = i > 0 ? i - 1 : i, b = std::min(i + 1, line.size() - 1);
    line[i].angle = (angle[b] - angle[a]) / (line[b].place - line[a].place);
  }
  return line;
}

RequestedElements requested_on_side(const DuctSpace& space, const VectorXd& unknowns) {
  std::vector<std::vector<LinePoint>> lines;
  for (const Camera camera : mirror_cameras(space.mesh().symmetry()))
    lines.push_back(line_on_side(space, unknowns, camera));
  return RequestedElements(lines);
}

std::vector<double> places_between_elements(const DuctSpace& space) {
  std::vector<double> places;
  for (const double height : std::views::reverse(space.mesh().side_breaks())) places.push_back(place_of(height));
  return places;
}

}  // namespace

std::vector<double> fitted_breaks(const DuctSpace& space, const VectorXd& unknowns, double evenly) {
  const auto places = requested_on_side(space, unknowns).moved(places_between_elements(space), evenly);
  std::vector<double> heights;
  for (const double place : std::views::reverse(places)) heights.push_back(height_at(place));
  return heights;
}

double surface_evenness(const DuctSpace& space, const VectorXd& unknowns) {
  return requested_on_side(space, unknowns).evenness(places_between_elements(space));
}

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

}  // namespace rheocyte
