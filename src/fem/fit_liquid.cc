#include "fem/fit_liquid.h"

#include <algorithm>
#include <cmath>

#include "fem/element_integrals.h"
#include "fem/fitted_mesh.h"
#include "fem/observe.h"

namespace rheocyte {
namespace {

/// Of the mesh that is fitted: it need not have all wiggles of a fine one's surface.
constexpr int max_degree = 6;
constexpr double same_line = 1e-10;
/// Elements on top are at most so long (in the cell's radius), turn by at most so much, and take at most so much of the
/// undeformed top (both in radians).
constexpr double longest = 0.6, most_turned = 0.7, widest = 0.6;
/// By how much their length may grow along themselves.
constexpr double growth = 0.4;

/// The same mesh at the degree at which it is fitted, and the way from and to the degree of the space.
class LiquidMesh {
 public:
  LiquidMesh(const Discretisation& space, const VectorXd& unknowns)
      : space_(space),
        unknowns_(unknowns),
        reference_(std::min(space.reference().degree(), max_degree)),
        numbers_(space.mesh().number_nodes(reference_.degree())),
        down_(space.reference().lagrange(reference_.nodes_1d)),
        up_(reference_.lagrange(space.reference().nodes_1d)),
        mesh_{reference_, {}, MatrixXd::Zero(numbers_.count, 2), {}, 0},
        places_(MatrixXd::Zero(numbers_.count, 2)) {
    for (int e = 0; e < int(space.elements().size()); ++e) {
      const auto& nodes = numbers_.of_element[e];
      if (!space.elements()[e].liquid) continue;
      elements_.push_back(e);
      mesh_.elements.push_back(nodes);
      const MatrixXd lower = applied(down_, places_of(e));
      const MeshElement& self = space.mesh().elements()[e];
      const VectorXd& s = reference_.nodes_1d;
      const int n = int(s.size());
      for (int k = 0; k < n * n; ++k) {
        mesh_.rest.row(nodes[k]) = self.map(space.mesh().geometry(), s(k % n), s(k / n)).transpose();
        places_.row(nodes[k]) = lower.row(k);
      }
    }
    number_unknowns();
  }

  double quality() const { return mesh_quality(mesh_, places_); }

  std::vector<Point> fitted() const {
    std::vector<Point> points = space_.node_points();
    const MatrixXd places = fitted_places(mesh_, places_);
    for (const int e : elements_) {
      const auto& nodes = space_.nodes().of_element[e];
      const MatrixXd move = applied(up_, (places - places_)(numbers_.of_element[e], Eigen::all));
      for (int k = 0; k < int(nodes.size()); ++k) {
        if (space_.displacement(nodes[k], 0) >= 0) continue;
        points[nodes[k]] = space_.node_points()[nodes[k]] + move.row(k).transpose();
      }
    }
    return points;
  }

 private:
  static MatrixXd applied(const MatrixXd& table, const MatrixXd& nodal) {
    MatrixXd result(table.rows() * table.rows(), nodal.cols());
    for (Eigen::Index c = 0; c < nodal.cols(); ++c) {
      const MatrixXd values = table * nodal.col(c).reshaped(table.cols(), table.cols()) * table.transpose();
      result.col(c) = values.reshaped();
    }
    return result;
  }

  /// Where an element's nodes are now.
  MatrixXd places_of(int e) const {
    const ElementUnknowns& element = space_.elements()[e];
    const auto& nodes = space_.nodes().of_element[e];
    const int m = element.position_columns;
    MatrixXd places(nodes.size(), 2);
    for (int k = 0; k < places.rows(); ++k) places.row(k) = space_.node_points()[nodes[k]].transpose();
    const VectorXd local = local_values(element, unknowns_);
    for (int c = 0; c < 2 && m > 0; ++c) places.col(c) += element.position->at_nodes[c] * local.segment(c * m, m);
    return places;
  }

  /// Nodes of the cell and of the channel's ends stay, those on the axis and at the wall slide.
  void number_unknowns() {
    mesh_.unknown.assign(numbers_.count, {-1, -1});
    std::vector<bool> is_of_cell(numbers_.count, false);
    for (int e = 0; e < int(space_.elements().size()); ++e) {
      for (const int node : numbers_.of_element[e])
        if (!space_.elements()[e].liquid) is_of_cell[node] = true;
    }
    const double end = space_.mesh().geometry().end();
    for (int i = 0; i < numbers_.count; ++i) {
      const double x = mesh_.rest(i, 0), r = mesh_.rest(i, 1);
      if (is_of_cell[i] || std::abs(x) > end - same_line) continue;
      mesh_.unknown[i][0] = mesh_.unknowns++;
      if (r > same_line && r < 1 - same_line) mesh_.unknown[i][1] = mesh_.unknowns++;
    }
  }

  const Discretisation& space_;
  const VectorXd& unknowns_;
  ReferenceElement<2> reference_;
  NodeNumbers numbers_;
  MatrixXd down_, up_;  ///< between the degrees: nodes x nodes in one direction
  MovableMesh<2> mesh_;
  MatrixXd places_;
  std::vector<int> elements_;  ///< those of the liquid
};

}  // namespace

namespace {

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

}  // namespace

SurfaceBreaks fitted_breaks(const Discretisation& space, const VectorXd& unknowns) {
  const auto [place, size] = wanted_sizes(space, unknowns);
  std::vector<double> elements{0};  // up to a place
  for (std::size_t i = 1; i < place.size(); ++i)
    elements.push_back(elements.back() + (place[i] - place[i - 1]) * (1 / size[i] + 1 / size[i - 1]) / 2);
  SurfaceBreaks breaks = space.mesh().breaks();
  const std::size_t n = breaks.top.size() - 1;
  for (std::size_t k = 1; k < n; ++k) {
    const double before = elements.back() * double(k) / double(n);
    const std::size_t i = std::size_t(std::ranges::lower_bound(elements, before) - elements.begin());
    const double part = (before - elements[i - 1]) / (elements[i] - elements[i - 1]);
    breaks.top[k] = std::lerp(place[i - 1], place[i], part);
  }
  return breaks;
}

double liquid_mesh_quality(const Discretisation& space, const VectorXd& unknowns) {
  return LiquidMesh(space, unknowns).quality();
}

std::vector<Point> fitted_points(const Discretisation& space, const VectorXd& unknowns) {
  return LiquidMesh(space, unknowns).fitted();
}

}  // namespace rheocyte
