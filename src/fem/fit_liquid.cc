#include "fem/fit_liquid.h"

#include <algorithm>
#include <cmath>

#include "fem/element_integrals.h"
#include "fem/liquid_mesh.h"
#include "fem/observe.h"

namespace rheocyte {
namespace {

/// Of the mesh that is fitted: it need not have all wiggles of a fine one's surface.
constexpr int max_degree = 6;
constexpr double same_line = 1e-10;
/// Elements on top are at most so long (in the cell's radius), turn by at most so much, and take at most so much of the
/// undeformed top (both in radians).
constexpr double longest = 0.6, most_turned = 0.5, widest = 0.6;
/// By how much their length may grow along themselves.
constexpr double growth = 0.4;

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

/// How long an element may be at places on top, from 0 to 1, as a part of it.
struct ElementSizes {
  std::vector<double> place, size;
};

ElementSizes wanted_sizes(const Discretisation& space, const VectorXd& unknowns) {
  constexpr int points_per_edge = 33;
  const ChannelGeometry& geometry = space.mesh().geometry();
  const double first = geometry.angle(Sector::top, 0), angle = geometry.angle(Sector::top, 1) - first;
  const SurfaceState surface = surface_state(space, unknowns, points_per_edge);
  ElementSizes sizes;
  for (Eigen::Index i = 0; i < surface.angle.size(); ++i) {
    const double here = (surface.angle(i) - first) / angle;
    if (here < -same_line || here > 1 + same_line || (!sizes.place.empty() && here <= sizes.place.back())) continue;
    const double length = surface.stretch(i, 0) * angle, turn = geometry.radius() * length * surface.curvature(i, 0);
    sizes.place.push_back(here);
    sizes.size.push_back(1 / (length / longest + std::abs(turn) / most_turned + angle / widest));
  }
  // Neighbours differ by little, from either side.
  const std::size_t n = sizes.size.size();
  const auto limit = [&](std::size_t i, std::size_t j) {
    sizes.size[i] = std::min(sizes.size[i], sizes.size[j] + growth * std::abs(sizes.place[i] - sizes.place[j]));
  };
  for (std::size_t i = 1; i < n; ++i) limit(i, i - 1);
  for (std::size_t i = n - 1; i-- > 0;) limit(i, i + 1);
  return sizes;
}

/// How many elements are requested from the front end of the top to places on it.
class RequestedElements {
 public:
  RequestedElements(const Discretisation& space, const VectorXd& unknowns) {
    const auto [place, size] = wanted_sizes(space, unknowns);
    place_ = place;
    for (std::size_t i = 1; i < place.size(); ++i)
      number_.push_back(number_.back() + (place[i] - place[i - 1]) * (1 / size[i] + 1 / size[i - 1]) / 2);
  }

  double all() const { return number_.back(); }
  double up_to(double place) const { return at(place_, number_, place); }
  double place_of(double number) const { return at(number_, place_, number); }

 private:
  static double at(const std::vector<double>& x, const std::vector<double>& y, double value) {
    const auto above = std::size_t(std::ranges::lower_bound(x, value) - x.begin());
    const std::size_t i = std::clamp<std::size_t>(above, 1, x.size() - 1);
    return std::lerp(y[i - 1], y[i], (value - x[i - 1]) / (x[i] - x[i - 1]));
  }

  std::vector<double> place_, number_{0};
};

}  // namespace

SurfaceBreaks fitted_breaks(const Discretisation& space, const VectorXd& unknowns, double evenly) {
  const RequestedElements requested(space, unknowns);
  SurfaceBreaks breaks = space.mesh().breaks();
  const std::size_t n = breaks.top.size() - 1;
  for (std::size_t k = 1; k < n; ++k)
    breaks.top[k] = std::lerp(breaks.top[k], requested.place_of(requested.all() * double(k) / double(n)), evenly);
  return breaks;
}

double surface_evenness(const Discretisation& space, const VectorXd& unknowns) {
  const RequestedElements requested(space, unknowns);
  const std::vector<double>& top = space.mesh().breaks().top;
  double most = 0;
  for (std::size_t k = 1; k < top.size(); ++k)
    most = std::max(most, requested.up_to(top[k]) - requested.up_to(top[k - 1]));
  return requested.all() / double(top.size() - 1) / most;
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
