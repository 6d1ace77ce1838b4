#include "view/state_json.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "case/json_guard.h"
#include "case/scales.h"
#include "duct/duct_symmetry.h"
#include "shape/convex_hull.h"
#include "shape/curve.h"
#include "store/base64.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;

constexpr int points_per_piece = 17;

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

Eigen::MatrixX2d closed_polygon(const Eigen::MatrixX2d& corners) {
  Eigen::MatrixX2d outline(corners.rows() + 1, 2);
  outline << corners, corners.row(0);
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

template <class Number>
constexpr const char* type_name = "uint8";
template <>
constexpr const char* type_name<float> = "float32";
template <>
constexpr const char* type_name<std::uint32_t> = "uint32";

/// Numbers of one name; within an object its name stands before a slash.
struct FieldArray {
  template <class Column>
  FieldArray(const char* n, const Column& column)
      : name(n),
        type(type_name<std::remove_cvref_t<decltype(*column.data())>>),
        count(std::size_t(column.size())),
        bytes(reinterpret_cast<const std::uint8_t*>(column.data()), count * sizeof(*column.data())) {}

  const char* name;
  const char* type;
  std::size_t count;
  std::span<const std::uint8_t> bytes;
};

Json tensions(const Result& result, double origin) {
  const SurfaceProfile& surface = result.state.surface;
  const double um = result.scales.length_um();
  Json json = curve(surface.point, um, origin);
  const double tension = 1e3 * result.scales.stress_Pa * result.scales.length_m;
  json["tension_mN_per_m"] = numbers(tension * surface.tension.col(0).array());
  json["tension_hoop_mN_per_m"] = numbers(tension * surface.tension.col(1).array());
  return json;
}

/// Whether the plane of the offset of a cell off the axis is that of the channel's height.
bool is_offset_in_height(const Result& result) {
  const std::vector<double>& offset = result.input.cell.offset_um;
  return offset.size() == 2 && offset[1] != 0;
}

/// Distance of the wall from the axis in the plane in which the fields are shown, in R.
double wall_distance(const Result& result) {
  const Problem& problem = result.problem;
  if (!is_duct(problem.section)) return 1;
  if (problem.offset != 0) return is_offset_in_height(result) ? problem.extent.height : problem.extent.width;
  const Camera shown = nearest_mirror(symmetry_of(problem.section), problem.camera);
  if (shown == Camera::diagonal) return std::numbers::sqrt2;
  return shown == Camera::side ? problem.extent.width : problem.extent.height;
}

/// In the plane that the camera looks at.
Json wall(const Result& result, double origin) {
  const double um = result.scales.length_um(), half = result.state.channel_length / 2;
  const double r = um * wall_distance(result);
  return {{"x_um", {um * (-half - origin), um * (half - origin)}}, {"r_um", {r, r}}};
}

/// The mesh has the offset along its second axis, the channel its height along the third.
void turn_to_height(auto& point) {
  point.col(1).swap(point.col(2));
  point.col(1) *= -1;
}

}  // namespace

ShownState::ShownState(Result result) : result_(std::move(result)), um_(result_.scales.length_um()) {
  if (result_.state.contour.pieces.empty()) return;
  outline_ = is_off_axis() ? closed_polygon(result_.state.offset_outline) : outline_of(result_.state.contour);
  origin_ = centroid(outline_);
}

Json ShownState::outlines() const {
  Json json{{"contour", curve(outline_, um_, origin_)}};
  for (const auto& [name, surface] : result_.state.views)
    json["contours"][name] = curve(closed({surface.point}), um_, origin_);
  return json;
}

Json ShownState::numbers() const {
  Json json = to_json(result_);
  if (outline_.rows() == 0) return json;
  json.update(outlines());
  const auto hull = is_off_axis() ? std::nullopt : hull_of(result_.state.contour);
  json["hull"] = hull ? curve(*hull, um_, origin_) : Json(nullptr);
  return json;
}

/// What the sampled fields say beside their numbers, and their numbers.
struct ShownState::Fields {
  Fields(const ShownState&, int points);
  /// Those of four bytes come first, so that each begins at a multiple of its size.
  std::vector<FieldArray> arrays() const;

  SampledFields sampled;
  Eigen::VectorXf speed;
  Json about;
};

ShownState::Fields::Fields(const ShownState& shown, int points)
    : sampled(shown.result_.state.sample_fields(shown.result_.scales, points)),
      speed(sampled.velocity_m_per_s.rowwise().norm()),
      about{{"points", sampled.point_um.rows()},
            {"triangles", sampled.triangles.size() / 3},
            {"wall", wall(shown.result_, shown.origin_)}} {
  if (!shown.is_off_axis()) about["surface"] = tensions(shown.result_, shown.origin_);
  if (is_offset_in_height(shown.result_)) turn_to_height(sampled.surface_um);
  const auto shift = float(shown.um_ * shown.origin_);
  sampled.point_um.col(0).array() -= shift;
  if (sampled.surface_um.rows() > 0) sampled.surface_um.col(0).array() -= shift;
}

std::vector<FieldArray> ShownState::Fields::arrays() const {
  std::vector<FieldArray> all{{"xy_um", sampled.point_um},
                              {"index", sampled.triangles},
                              {"values/speed_m_per_s", speed},
                              {"values/velocity_m_per_s", sampled.velocity_m_per_s},
                              {"values/pressure_Pa", sampled.pressure_Pa},
                              {"values/shear_rate_per_s", sampled.shear_rate_per_s},
                              {"values/stress_Pa", sampled.stress_Pa},
                              {"values/stretch", sampled.stretch},
                              {"values/displacement_um", sampled.displacement_um}};
  if (sampled.surface_um.rows() > 0) {
    all.emplace_back("surface3d/xyz_um", sampled.surface_um);
    all.emplace_back("surface3d/index", sampled.surface_triangles);
  }
  all.emplace_back("region", sampled.in_cell);
  return all;
}

std::string ShownState::fields(int points) const {
  if (!has_fields()) return {};
  const Fields fields(*this, points);
  Json json = fields.about;
  for (const FieldArray& array : fields.arrays())
    json[Json::json_pointer(std::string("/") + array.name)] = base64(array.bytes);
  return json_line(json);
}

void ShownState::give_fields(const TakePiece& take) const {
  if (!has_fields()) return;
  const Fields fields(*this, usual_points);
  Json head = fields.about;
  std::string bytes;
  for (const FieldArray& array : fields.arrays()) {
    head["arrays"].push_back({{"name", array.name}, {"type", array.type}, {"count", array.count}});
    bytes.append(reinterpret_cast<const char*>(array.bytes.data()), array.bytes.size());
  }
  if (take(json_line(head) + "\n")) take(bytes);
}

bool ShownState::has_fields() const { return result_.state.sample_fields && outline_.rows() > 0; }

}  // namespace rheocyte
