#include "solve/describe_duct.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "duct/cell_moments.h"
#include "duct/duct_ends.h"
#include "duct/sample_duct_fields.h"
#include "duct/write_duct_fields.h"
#include "laws/surface_form.h"
#include "shape/outline_shape.h"
#include "solve/surface_stability.h"

namespace rheocyte {
namespace {

/// Cameras whose silhouettes are told of every state with a centred cell.
std::vector<std::pair<std::string_view, Camera>> views_of(const Problem& problem) {
  if (problem.offset != 0) return {};
  std::vector<std::pair<std::string_view, Camera>> views{{"side", Camera::side}};
  if (problem.section != Section::rectangle) views.emplace_back("diagonal", Camera::diagonal);
  return views;
}

/// Moves along the flow.
void shift(double by, Contour& contour) {
  for (CurvePiece& piece : contour.pieces) piece.col(0).array() += by;
}

/// Tensions along and across a silhouette, whose stretches are given, from the principal ones.
std::array<double, 2> tensions(const Cortex& cortex, double along, const Eigen::RowVector2d& principal) {
  const auto [T1, T2] = principal_tensions<double>(cortex, principal(0), principal(1));
  const auto inverse_square = [](double stretch) { return 1 / (stretch * stretch); };
  const double whole = inverse_square(principal(0)) - inverse_square(principal(1));
  // Squared cosine of the angle between the silhouette and the first principal direction.
  const double share =
      whole == 0 ? 1 : std::clamp((inverse_square(along) - inverse_square(principal(1))) / whole, 0.0, 1.0);
  return {share * T1 + (1 - share) * T2, share * T2 + (1 - share) * T1};
}

/// The surface along a silhouette.
SurfaceProfile profile(const DuctSpace& space, const VectorXd& unknowns, const Cortex& cortex, Camera camera,
                       double barycentre) {
  const DuctMeridian meridian = duct_meridian(
      space, unknowns, camera, VectorXd::LinSpaced(SurfaceProfile::points_per_piece, 0, 1), cortex.rest_stretch);
  SurfaceProfile profile{meridian.rest_angle, meridian.point, meridian.stretch,
                         Eigen::MatrixX2d::Zero(meridian.point.rows(), 2), meridian.curvature};
  for (Eigen::Index i = 0; i < profile.tension.rows(); ++i) {
    const auto [along, across] = tensions(cortex, meridian.stretch(i, 0), meridian.principal.row(i));
    profile.tension.row(i) << along, across;
  }
  profile.point.col(0).array() -= barycentre;
  return profile;
}

SurfaceExtremes surface_extremes(const Cortex& cortex, const Eigen::MatrixX2d& stretch) {
  double min_tension = std::numeric_limits<double>::infinity();
  for (const auto& row : stretch.rowwise()) {
    const auto [T1, T2] = principal_tensions<double>(cortex, row(0), row(1));
    min_tension = std::min({min_tension, T1, T2});
  }
  // Incompressible: the normal stretch is 1 / (least greatest).
  return {(stretch.col(0).array().square() * stretch.col(1).array()).minCoeff(), min_tension};
}

void read_flow(const Media& media, const DuctDiscrete& discrete, const VectorXd& unknowns, StateNumbers& r) {
  const DuctGeometry& geometry = discrete.space.mesh().geometry();
  const double half = geometry.half_length(),
               outlet = -discrete.system.drop() * half * discrete.system.undisturbed_gradient(media.liquid);
  r.cell_velocity = unknowns(discrete.space.cell_velocity());
  r.reynolds = media.liquid.reynolds * r.cell_velocity;
  r.channel_length = 2 * half;
  r.pressure_drop = duct_inlet_pressure(discrete.space, unknowns) - outlet;
  r.flow_rate = duct_flow_rate(discrete.space, unknowns);
  r.volume_flow = r.flow_rate * geometry.area();
  const double undisturbed = discrete.space.has_open_inlet()
                                 ? discrete.space.section().gradient_at(media.liquid, r.flow_rate)
                                 : discrete.system.undisturbed_gradient(media.liquid);
  r.additional_pressure_drop = r.pressure_drop - 2 * half * undisturbed;
  r.tube_radius = no_value;
  r.shear_rate_max = max_shear_rate(discrete.space, discrete.system.element(), unknowns);
}

/// Numbers of a cell off the axis.
void read_turning(const DuctDiscrete& discrete, const VectorXd& unknowns, StateNumbers& r) {
  const DuctSpace& space = discrete.space;
  if (!space.turns()) return;
  r.drift_velocity = unknowns(space.drift());
  r.spin = unknowns(space.spin());
  r.offset = cell_moments(space, discrete.system.element(), unknowns).barycentre(1);
  Polygon outline;
  const Eigen::MatrixX2d corners = duct_offset_outline(space, unknowns);
  outline.assign(std::vector<Eigen::Vector2d>(corners.rowwise().begin(), corners.rowwise().end()));
  r.tilt = outline_tilt(outline, hull_asymmetry(outline).sine_modes, 1);
}

}  // namespace

DuctShape shape_of(const Problem& problem) {
  DuctShape shape{problem.section, problem.radius_ratio, problem.extent, problem.channel_length};
  if (problem.offset == 0) return shape;
  shape.offset = problem.offset;
  if (problem.camera == Camera::side) std::swap(shape.extent.width, shape.extent.height);
  return shape;
}

Symmetry symmetry_of(const Problem& problem) {
  return problem.offset == 0 ? symmetry_of(problem.section) : Symmetry::half;
}

Camera camera_in_mesh(const Problem& problem) { return problem.offset == 0 ? problem.camera : Camera{90}; }

DuctSubdivision subdivision_of(const Problem& problem) {
  constexpr double narrow_gap = 0.88;
  if (problem.offset == 0) return {.along = problem.radius_ratio > narrow_gap ? 4 : 3};
  return {.along = 2, .across = 2};
}

double duct_deformation(const DuctSpace& space, const VectorXd& unknowns, Camera camera) {
  return measure(duct_contour(space, unknowns, camera)).deformation;
}

double duct_stability_margin(const Problem& problem, const DuctSpace& space, const VectorXd& unknowns) {
  const auto stretch = duct_principal_stretches(space, unknowns, problem.cortex.rest_stretch);
  return stability_margin(problem, problem.radius_ratio, surface_extremes(problem.cortex, stretch));
}

StateNumbers duct_numbers(const Problem& problem, const DuctDiscrete& discrete, const VectorXd& unknowns) {
  const DuctSpace& space = discrete.space;
  StateNumbers r;
  r.shape = measure(duct_contour(space, unknowns, camera_in_mesh(problem)));
  r.volume_of_revolution = r.shape.volume;
  const CellVolume volume = cell_volume(space, discrete.system.element(), unknowns);
  r.shape.volume = volume.volume;
  if (problem.offset == 0) r.deformation_side = duct_deformation(space, unknowns, Camera::side);
  if (problem.offset == 0 && problem.section != Section::rectangle)
    r.deformation_diagonal = duct_deformation(space, unknowns, Camera::diagonal);
  const double a = space.mesh().geometry().radius();
  r.relative_volume_change = volume.volume / (4.0 / 3 * std::numbers::pi * a * a * a) - 1;
  read_flow(problem, discrete, unknowns, r);
  const auto stretch = duct_principal_stretches(space, unknowns, problem.cortex.rest_stretch);
  const SurfaceExtremes surface = surface_extremes(problem.cortex, stretch);
  r.min_meridional_stretch = stretch.col(0).minCoeff();
  r.biot_ratio = surface.biot_ratio;
  r.stability_margin = stability_margin(problem, problem.radius_ratio, surface);
  r.min_tension = surface.min_tension;
  if (const int p = space.inner_pressure(); p >= 0)
    r.inner_pressure = unknowns(p) + rest_pressure(problem.cortex, problem.radius_ratio);
  read_turning(discrete, unknowns, r);
  return r;
}

void describe_duct(const Problem& problem, const DuctDiscrete& discrete, const VectorXd& unknowns, StationaryState& r) {
  const DuctSpace& space = discrete.space;
  const CellVolume volume = cell_volume(space, discrete.system.element(), unknowns);
  for (const auto& [name, camera] : views_of(problem))
    r.views.push_back({name, profile(space, unknowns, problem.cortex, camera, volume.barycentre)});
  const Camera seen_from = camera_in_mesh(problem);
  r.surface = profile(space, unknowns, problem.cortex, seen_from, volume.barycentre);
  r.contour = duct_contour(space, unknowns, seen_from);
  shift(-volume.barycentre, r.contour);
  if (space.turns()) {
    r.offset_outline = duct_offset_outline(space, unknowns);
    r.offset_outline.col(0).array() -= volume.barycentre;
  }
  static_cast<StateNumbers&>(r) = duct_numbers(problem, discrete, unknowns);
  r.statistics.unknowns = space.unknowns();
  r.statistics.elements = int(space.elements().size());
  r.statistics.degree = space.reference().degree();
  const Media media = problem;
  r.write_fields = [shared = discrete.shared_space, media, unknowns](const std::string& path, const Scales& scales) {
    return write_duct_fields(*shared, media, unknowns, scales, path);
  };
  if (space.turns()) return;  // pictures show halves of planes through the axis
  r.sample_fields = [=, shared = discrete.shared_space, camera = problem.camera](const Scales& scales, int points) {
    SampledFields fields = sample_duct_fields(*shared, media, unknowns, scales, camera, points);
    const auto place = float(scales.length_um() * volume.barycentre);
    fields.point_um.col(0).array() -= place;
    fields.surface_um.col(0).array() -= place;
    return fields;
  };
}

}  // namespace rheocyte
