#include "view/state_json.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "case/json_guard.h"
#include "case/scales.h"
#include "shape/convex_hull.h"
#include "shape/curve.h"
#include "view/base64.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;

constexpr double um_per_m = 1e6;
constexpr int points_per_piece = 17, points_in_sample = 6000;

/// A meridian from the front pole to the rear one as the closed outline that the camera sees; x, r by rows.
Eigen::MatrixX2d closed(const std::vector<Eigen::MatrixX2d>& pieces) {
  std::vector<Eigen::RowVector2d> upper;
  for (const auto& piece : pieces)
    for (Eigen::Index i = upper.empty() ? 0 : 1; i < piece.rows(); ++i) upper.push_back(piece.row(i));
  const auto n = Eigen::Index(upper.size());
  Eigen::MatrixX2d outline(2 * n - 1, 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    outline.row(i) = upper[std::size_t(i)];
    outline.row(2 * n - 2 - i) << upper[std::size_t(i)](0), -upper[std::size_t(i)](1);
  }
  return outline;
}

Eigen::MatrixX2d outline_of(const Contour& contour) {
  const Eigen::VectorXd at = Eigen::VectorXd::LinSpaced(points_per_piece, 0, 1);
  std::vector<Eigen::MatrixX2d> pieces;
  for (const CurvePiece& piece : contour.pieces) pieces.push_back(evaluate(piece, at));
  return closed(pieces);
}

/// Nothing where the contour has no hull.
std::optional<Eigen::MatrixX2d> hull_of(const Contour& contour) {
  const auto meridian = SampledMeridian::of(contour);
  const auto hull = meridian ? convex_hull(*meridian, HullParts::all) : std::nullopt;
  if (!hull) return std::nullopt;
  std::vector<Eigen::MatrixX2d> pieces;
  for (const CurveArc& arc : hull->arcs)
    pieces.push_back(evaluate(arc.piece, Eigen::VectorXd::LinSpaced(points_per_piece, arc.start, arc.end)));
  return closed(pieces);
}

/// Axial coordinate of the centroid of the area within.
double centroid(const Eigen::MatrixX2d& outline) {
  double area = 0, moment = 0;
  for (Eigen::Index i = 0; i + 1 < outline.rows(); ++i) {
    const double cross = outline(i, 0) * outline(i + 1, 1) - outline(i + 1, 0) * outline(i, 1);
    area += cross;
    moment += cross * (outline(i, 0) + outline(i + 1, 0)) / 3;
  }
  return moment / area;
}

Json numbers(const auto& column) { return std::vector<double>(column.begin(), column.end()); }

Json curve(const Eigen::MatrixX2d& points, double um, double origin) {
  return {{"x_um", numbers(um * (points.col(0).array() - origin))}, {"r_um", numbers(um * points.col(1).array())}};
}

template <class Column>
Json packed(const Column& column) {
  return base64_of(column.data(), std::size_t(column.size()));
}

double origin_of(const Result& result) { return centroid(outline_of(result.state.contour)); }

Json tensions(const Result& result, double origin) {
  const SurfaceProfile& surface = result.state.surface;
  const double um = um_per_m * result.scales.length_m;
  Json json = curve(surface.point, um, origin);
  const double tension = 1e3 * result.scales.stress_Pa * result.scales.length_m;
  json["tension_mN_per_m"] = numbers(tension * surface.tension.col(0).array());
  json["tension_hoop_mN_per_m"] = numbers(tension * surface.tension.col(1).array());
  return json;
}

/// In the plane that the camera looks at.
Json wall(const Result& result, double origin) {
  const double um = um_per_m * result.scales.length_m, half = result.state.channel_length / 2;
  const bool to_corner = result.problem.section == Section::square && result.problem.camera == Camera::diagonal;
  const double r = um * (to_corner ? std::numbers::sqrt2 : 1);
  return {{"x_um", {um * (-half - origin), um * (half - origin)}}, {"r_um", {r, r}}};
}

}  // namespace

Json outline_json(const Contour& contour, double um) {
  const Eigen::MatrixX2d outline = outline_of(contour);
  return curve(outline, um, centroid(outline));
}

Json state_json(const Result& result) {
  Json json = to_json(result);
  const Contour& contour = result.state.contour;
  if (contour.pieces.empty()) return json;
  const double um = um_per_m * result.scales.length_m;
  const Eigen::MatrixX2d outline = outline_of(contour);
  const double origin = centroid(outline);
  json["contour"] = curve(outline, um, origin);
  const auto hull = hull_of(contour);
  json["hull"] = hull ? curve(*hull, um, origin) : Json(nullptr);
  if (result.problem.section == Section::square)
    for (const auto& [name, camera] : {std::pair{"side", Camera::side}, std::pair{"diagonal", Camera::diagonal}})
      json["contours"][name] = curve(closed({result.state.views[std::size_t(camera)].point}), um, origin);
  return json;
}

std::string fields_json(const Result& result) {
  if (!result.state.sample_fields || result.state.contour.pieces.empty()) return {};
  SampledFields s = result.state.sample_fields(result.scales, points_in_sample);
  const double origin = origin_of(result);
  const auto shift = float(um_per_m * result.scales.length_m * origin);
  s.point_um.col(0).array() -= shift;
  if (s.surface_um.rows() > 0) s.surface_um.col(0).array() -= shift;
  const Eigen::VectorXf speed = s.velocity_m_per_s.rowwise().norm();
  Json json{{"points", s.point_um.rows()},
            {"triangles", s.triangles.size() / 3},
            {"xy_um", packed(s.point_um)},
            {"index", packed(s.triangles)},
            {"region", packed(s.in_cell)},
            {"values",
             {{"speed_m_per_s", packed(speed)},
              {"velocity_m_per_s", packed(s.velocity_m_per_s)},
              {"pressure_Pa", packed(s.pressure_Pa)},
              {"shear_rate_per_s", packed(s.shear_rate_per_s)},
              {"stress_Pa", packed(s.stress_Pa)},
              {"stretch", packed(s.stretch)},
              {"displacement_um", packed(s.displacement_um)}}},
            {"surface", tensions(result, origin)},
            {"wall", wall(result, origin)}};
  if (s.surface_um.rows() > 0)
    json["surface3d"] = {{"xyz_um", packed(s.surface_um)}, {"index", packed(s.surface_triangles)}};
  return json_line(json);
}

}  // namespace rheocyte
