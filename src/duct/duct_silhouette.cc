#include "duct/duct_silhouette.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "duct/farthest_place.h"
#include "duct/outline_off_axis.h"
#include "numeric/roots.h"
#include "shape/curve.h"

namespace rheocyte {
namespace {

constexpr double right_angle = std::numbers::pi / 2;
/// Of a contour's pieces at least: arcs of the sphere then are round to 1e-12.
constexpr int contour_degree = 9;

/// Axes of a camera.
struct View {
  Camera camera;
  double angle;             ///< in radians
  DuctPoint sight, across;  ///< the direction of sight, and the one across the flow in the image

  explicit View(Camera from)
      : camera(from),
        angle(from.degrees * std::numbers::pi / 180),
        sight(0, -std::sin(angle), std::cos(angle)),
        across(0, std::cos(angle), std::sin(angle)) {}
};

/// Where y and z may be exchanged, a camera beyond the diagonal sees what one before it sees.
View view_of(const DuctSpace& space, Camera camera) {
  const bool folds = space.mesh().symmetry() == Symmetry::eighth && camera.degrees > 45;
  return View(folds ? Camera{90 - camera.degrees} : camera);
}

/// Pieces of a silhouette; on each one the places at the same parameters, from front to rear.
using Pieces = std::vector<std::vector<SurfacePlace>>;

/// An edge of a face in a plane of symmetry.
struct MeridianEdge {
  SurfacePlace front, rear;
  double x;  ///< of its front end
};

std::vector<MeridianEdge> meridian_edges(const DuctSurfaceMap& surface, const View& view) {
  const int n = surface.space().reference().degree() + 1;
  const auto& points = surface.space().node_points();
  std::vector<MeridianEdge> edges;
  for (int f = 0; f < int(surface.faces().size()); ++f) {
    const auto& nodes = surface.faces()[f].nodes;
    for (int side = 0; side < 4; ++side) {
      const auto node = [&](int k) {
        const int fixed = side % 2 * (n - 1);
        return nodes[side < 2 ? k + n * fixed : fixed + n * k];
      };
      bool in_plane = true;
      for (int k = 0; k < n; ++k) in_plane = in_plane && std::abs(view.sight.dot(points[node(k)])) < same_place;
      if (!in_plane) continue;
      const double at = side % 2;
      SurfacePlace first{f, 0, at}, last{f, 1, at};
      if (side >= 2) first = {f, at, 0}, last = {f, at, 1};
      if (points[node(0)](0) < points[node(n - 1)](0)) std::swap(first, last);
      edges.push_back({first, last, std::max(points[node(0)](0), points[node(n - 1)](0))});
    }
  }
  std::ranges::sort(edges, std::ranges::greater{}, &MeridianEdge::x);
  return edges;
}

Pieces meridian(const std::vector<MeridianEdge>& edges, const VectorXd& along) {
  Pieces pieces;
  for (const MeridianEdge& edge : edges) {
    auto& piece = pieces.emplace_back();
    const auto &a = edge.front, &b = edge.rear;
    for (const double u : along) piece.push_back({a.face, a.s + u * (b.s - a.s), a.t + u * (b.t - a.t)});
  }
  return pieces;
}

/// The silhouette of cameras that look along no plane of symmetry: on each curve from pole to pole over the cube,
/// between neighbouring planes of symmetry, the place whose normal is at right angles to the view.
class Envelope {
 public:
  Envelope(const DuctSurfaceMap& surface, const View& view) : surface_(surface), view_(view) {
    const Symmetry symmetry = surface.space().mesh().symmetry();
    last_angle_ = symmetry == Symmetry::eighth ? right_angle / 2 : right_angle;
  }

  Pieces pieces(const VectorXd& along) const {
    Pieces result;
    const std::vector<double>& heights = surface_.space().mesh().side_breaks();
    const auto add = [&](Face face, double from, double to) {
      auto& piece = result.emplace_back();
      for (const double u : along) piece.push_back(place(face, from + u * (to - from)));
      // Normals of neighbouring faces differ a little at their edge.
      if (result.size() > 1) piece.front() = result[result.size() - 2].back();
    };
    add(Face::front, 0, 0.5);
    add(Face::front, 0.5, 1);
    for (auto i = heights.size() - 1; i > 0; --i) add(Face::side, heights[i], heights[i - 1]);
    add(Face::rear, 1, 0.5);
    add(Face::rear, 0.5, 0);
    return result;
  }

 private:
  /// On the side at height X of the cube, in front and rear at the distance `u` from the pole.
  SurfacePlace place(Face face, double u) const {
    const auto looks_past = [&](double angle) {
      const SurfaceJet jet = surface_.now(at(face, u, angle));
      return jet.s.cross(jet.t).dot(view_.sight);
    };
    const bool at_pole = face != Face::side && u == 0;
    const bool changes = !at_pole && (looks_past(0) < 0) != (looks_past(last_angle_) < 0);
    return at(face, u, changes ? bracketed_root(looks_past, 0, last_angle_, 1e-13) : view_.angle);
  }

  /// The place over the cube's point in this direction round the flow.
  SurfacePlace at(Face face, double u, double angle) const {
    const bool swaps = angle > right_angle / 2;
    const double slope = std::tan(swaps ? right_angle - angle : angle);
    const FacePoint wanted = face == Face::side ? FacePoint(slope, u) : FacePoint(u, u * slope);
    for (int f = 0; f < int(surface_.faces().size()); ++f) {
      const DuctElement& element = surface_.space().mesh().elements()[surface_.faces()[f].element];
      if (element.face != face || element.image.swaps != swaps || element.image.y < 0) continue;
      if (const auto found = inverse(element.corners, wanted)) return {f, (*found)(0), (*found)(1)};
    }
    return {};
  }

  /// Coordinates in the bilinear quadrilateral, if they lie in it: t solves a quadratic equation.
  static std::optional<Eigen::Vector2d> inverse(const std::array<FacePoint, 4>& c, const FacePoint& wanted) {
    const auto cross = [](const FacePoint& a, const FacePoint& b) { return a(0) * b(1) - a(1) * b(0); };
    const FacePoint e = c[1] - c[0], f = c[2] - c[0], g = c[0] - c[1] - c[2] + c[3], h = wanted - c[0];
    const double k2 = cross(g, f), k1 = cross(e, f) + cross(h, g), k0 = cross(h, e);
    const double half = -(k1 + std::copysign(std::sqrt(std::max(0.0, k1 * k1 - 4 * k2 * k0)), k1)) / 2;
    for (const double t : {k0 / half, half / k2}) {
      const FacePoint along = e + t * g, rest = h - t * f;
      const double s = along.dot(rest) / along.squaredNorm();
      constexpr double outside = 1e-9;
      if (s > -outside && s < 1 + outside && t > -outside && t < 1 + outside) return Eigen::Vector2d(s, t);
    }
    return {};
  }

  const DuctSurfaceMap& surface_;
  View view_;
  double last_angle_;
};

/// Of a cell off the axis: the places that lie farthest in the directions from front to rear.
Pieces farthest_places(const DuctSurfaceMap& surface, const View& view, const VectorXd& along) {
  const FarthestPlace farthest(surface);
  Pieces result(off_axis_pieces);
  for (int i = 0; i < off_axis_pieces; ++i) {
    for (const double u : along)
      result[i].push_back(farthest(outline_direction(view.across, std::numbers::pi * (i + u) / off_axis_pieces)));
  }
  return result;
}

Pieces silhouette(const DuctSurfaceMap& surface, const View& view, const VectorXd& along) {
  if (surface.space().turns()) return farthest_places(surface, view, along);
  const std::vector<Camera> mirrors = mirror_cameras(surface.space().mesh().symmetry());
  if (std::ranges::find(mirrors, view.camera) == mirrors.end()) return Envelope(surface, view).pieces(along);
  return meridian(meridian_edges(surface, view), along);
}

/// Along the silhouette in the image, and across it by the stretch of the area.
Eigen::Vector2d stretches(const SurfaceJet& now, const SurfaceJet& rest, const DuctPoint& sight) {
  const DuctPoint along = now.normal().cross(sight);
  const double E = now.s.squaredNorm(), F = now.s.dot(now.t), G = now.t.squaredNorm(), det = E * G - F * F;
  const double b = now.s.dot(along), c = now.t.dot(along);
  const DuctPoint before = (G * b - F * c) / det * rest.s + (E * c - F * b) / det * rest.t;
  const double stretch = along.norm() / before.norm();
  return {stretch, now.area() / rest.area() / stretch};
}

/// The least first: squares are the eigenvalues of rest^-1 now.
Eigen::RowVector2d principal_stretches(const SurfaceJet& now, const SurfaceJet& rest) {
  const double E = rest.s.squaredNorm(), F = rest.s.dot(rest.t), G = rest.t.squaredNorm(), det = E * G - F * F;
  const double squares = (G * now.s.squaredNorm() - 2 * F * now.s.dot(now.t) + E * now.t.squaredNorm()) / det;
  const double product = now.area() / rest.area(),
               gap = std::sqrt(std::max(0.0, squares * squares / 4 - product * product));
  const double greatest = std::sqrt(squares / 2 + gap);
  return {product / greatest, greatest};
}

/// Of the outline in the image, and along the line of sight; both 1/a for a sphere of radius a. The first is Gauss'
/// curvature over the second (Koenderink 1984).
Eigen::Vector2d curvatures(const SurfaceJet& now, const DuctPoint& sight) {
  const DuctPoint n = now.normal();
  const double E = now.s.squaredNorm(), F = now.s.dot(now.t), G = now.t.squaredNorm(), det = E * G - F * F;
  const double e = -now.ss.dot(n), f = -now.st.dot(n), g = -now.tt.dot(n);
  const double b = now.s.dot(sight), c = now.t.dot(sight), s = (G * b - F * c) / det, t = (E * c - F * b) / det;
  const double of_sight = (e * s * s + 2 * f * s * t + g * t * t) / (E * s * s + 2 * F * s * t + G * t * t);
  return {(e * g - f * f) / det / of_sight, of_sight};
}

}  // namespace

Contour duct_contour(const DuctSpace& space, const VectorXd& unknowns, Camera camera) {
  const DuctSurfaceMap surface(space, unknowns);
  const View view = view_of(space, camera);
  if (space.turns()) return off_axis_contour(surface, view.across);
  Contour contour;
  const VectorXd& along = lobatto_nodes(std::max(space.reference().degree(), contour_degree));
  for (const auto& places : silhouette(surface, view, along)) {
    CurvePiece& piece = contour.pieces.emplace_back(places.size(), 2);
    for (int k = 0; k < piece.rows(); ++k) {
      const DuctPoint x = surface.point(places[k]);
      piece.row(k) << x(0), view.across.dot(x);
    }
  }
  // Round-off must not put a pole beyond the axis.
  contour.pieces.front()(0, 1) = 0;
  contour.pieces.back()(contour.pieces.back().rows() - 1, 1) = 0;
  return contour;
}

DuctMeridian duct_meridian(const DuctSpace& space, const VectorXd& unknowns, Camera camera, const VectorXd& parameters,
                           double rest_stretch) {
  const DuctSurfaceMap surface(space, unknowns);
  const View view = view_of(space, camera);
  const Pieces pieces = silhouette(surface, view, parameters);
  const Eigen::Index all = parameters.size() * Eigen::Index(pieces.size());
  DuctMeridian meridian{VectorXd(all), Eigen::MatrixX2d(all, 2), Eigen::MatrixX2d(all, 2), Eigen::MatrixX2d(all, 2),
                        Eigen::MatrixX2d(all, 2)};
  Eigen::Index row = 0;
  for (const auto& piece : pieces) {
    for (const SurfacePlace& place : piece) {
      const SurfaceJet now = surface.now(place);
      SurfaceJet rest = surface.rest(place);
      meridian.rest_angle(row) = std::atan2(rest.x.tail<2>().norm(), rest.x(0));
      for (DuctPoint* slope : {&rest.s, &rest.t}) *slope = at_rest(*slope, rest_stretch);
      meridian.point.row(row) << now.x(0), view.across.dot(now.x);
      meridian.stretch.row(row) = stretches(now, rest, view.sight).transpose();
      meridian.curvature.row(row) = curvatures(now, view.sight).transpose();
      meridian.principal.row(row) = principal_stretches(now, rest);
      ++row;
    }
  }
  return meridian;
}

}  // namespace rheocyte
