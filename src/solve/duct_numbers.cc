// What is reported of a state in a duct: its contour, numbers and fields.
#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "duct/cell_moments.h"
#include "duct/duct_ends.h"
#include "duct/duct_fields.h"
#include "duct/outline_off_axis.h"
#include "fem/write_fields.h"
#include "laws/surface_form.h"
#include "shape/outline_shape.h"
#include "solve/duct.h"
#include "solve/surface_stability.h"

namespace rheocyte {
namespace {

Camera camera_in_mesh(const Problem& problem) { return problem.offset == 0 ? problem.camera : Camera{90}; }

/// Whether the channel of a centred cell looks alike along width and height.
bool is_square(const Problem& problem) { return symmetry_of(problem) == Symmetry::eighth; }

/// Cameras whose silhouettes are reported of every state with a centred cell.
std::vector<std::pair<std::string_view, Camera>> views_of(const Problem& problem) {
  if (problem.offset != 0) return {};
  std::vector<std::pair<std::string_view, Camera>> views{{"side", Camera::side}};
  views.emplace_back(is_square(problem) ? std::pair{"diagonal", Camera::diagonal}
                                        : std::pair{"across", Camera::along_width});
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
  const double fraction =
      whole == 0 ? 1 : std::clamp((inverse_square(along) - inverse_square(principal(1))) / whole, 0.0, 1.0);
  return {fraction * T1 + (1 - fraction) * T2, fraction * T2 + (1 - fraction) * T1};
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

SurfaceExtremes surface_extremes(const Media& media, const Eigen::MatrixX2d& stretch) {
  constexpr double none = std::numeric_limits<double>::infinity();
  SurfaceExtremes least{none, none};
  for (const auto& row : stretch.rowwise()) {
    const auto [T1, T2] = principal_tensions<double>(media.cortex, row(0), row(1));
    least.min_tension = std::min({least.min_tension, T1, T2});
    least.wrinkling_margin = std::min(least.wrinkling_margin, wrinkling_margin(media.bulk, row(0), row(1)));
  }
  return least;
}

void read_flow(const Problem& problem, const DuctDiscrete& discrete, const VectorXd& unknowns, StateNumbers& r) {
  const Media& media = problem;
  const DuctGeometry& geometry = discrete.space().mesh().geometry();
  const double half = geometry.half_length();
  // Where the mesh ends the pressure is given.
  const double outlet = geometry.end() == half ? -discrete.system().inlet_pressure(media.liquid)
                                               : duct_end_pressure(discrete.space(), unknowns, Face::front);
  r.cell_velocity = unknowns(discrete.space().cell_velocity());
  r.reynolds = media.liquid.reynolds * r.cell_velocity;
  r.channel_length = 2 * half;
  r.pressure_drop = duct_end_pressure(discrete.space(), unknowns, Face::rear) - outlet;
  r.flow_rate = duct_flow_rate(discrete.space(), unknowns);
  r.volume_flow = r.flow_rate * geometry.area();
  const double undisturbed = discrete.space().has_open_inlet()
                                 ? discrete.space().section().gradient_at(media.liquid, r.flow_rate)
                                 : discrete.system().undisturbed_gradient(media.liquid);
  if (problem.wall.is_straight()) r.additional_pressure_drop = r.pressure_drop - 2 * half * undisturbed;
  r.tube_radius = no_value;
  r.shear_rate_max = max_shear_rate(discrete.space(), discrete.system().element(), unknowns);
}

/// Numbers of a cell off the axis.
void read_turning(const DuctDiscrete& discrete, const VectorXd& unknowns, StateNumbers& r) {
  const DuctSpace& space = discrete.space();
  if (!space.turns()) return;
  r.drift_velocity = unknowns(space.drift());
  r.spin = unknowns(space.spin());
  r.offset = cell_moments(space, discrete.system().element(), unknowns).barycentre(1) + space.aside();
  Polygon outline;
  const Eigen::MatrixX2d corners = duct_offset_outline(space, unknowns);
  outline.assign(std::vector<Eigen::Vector2d>(corners.rowwise().begin(), corners.rowwise().end()));
  r.tilt = outline_tilt(outline, hull_asymmetry(outline).sine_modes, 1);
}

/// Deformations of a centred cell, as cameras see it.
void read_silhouettes(const Problem& problem, const DuctSpace& space, const VectorXd& unknowns, StateNumbers& r) {
  const auto seen_by = [&](Camera camera) { return duct_deformation(space, unknowns, camera); };
  r.deformation_side = r.deformation_across = seen_by(Camera::side);
  if (is_square(problem))
    r.deformation_diagonal = seen_by(Camera::diagonal);
  else
    r.deformation_across = seen_by(Camera::along_width);
}

}  // namespace

Contour DuctDiscrete::contour(const Problem& problem, const VectorXd& unknowns) const {
  return duct_contour(space(), unknowns, camera_in_mesh(problem));
}

double DuctDiscrete::stability_margin(const Problem& problem, const VectorXd& unknowns) const {
  const auto stretch = duct_principal_stretches(space(), unknowns, problem.cortex.rest_stretch);
  return rheocyte::stability_margin(problem, problem.radius_ratio, surface_extremes(problem, stretch));
}

bool DuctDiscrete::is_wrinkled(const Problem& problem, const VectorXd& unknowns) const {
  return stability_margin(problem, unknowns) < 0;
}

double duct_deformation(const DuctSpace& space, const VectorXd& unknowns, Camera camera) {
  return measure(duct_contour(space, unknowns, camera)).deformation;
}

StateNumbers DuctDiscrete::numbers(const Problem& problem, const VectorXd& unknowns) const {
  const DuctSpace& space = this->space();
  StateNumbers r;
  r.shape = measure(contour(problem, unknowns));
  r.volume_of_revolution = r.shape.volume;
  const CellVolume volume = cell_volume(space, system_->element(), unknowns);
  r.shape.volume = volume.volume;
  if (problem.offset == 0) read_silhouettes(problem, space, unknowns, r);
  const double a = space.mesh().geometry().radius();
  r.relative_volume_change = volume.volume / (4.0 / 3 * std::numbers::pi * a * a * a) - 1;
  read_flow(problem, *this, unknowns, r);
  const auto stretch = duct_principal_stretches(space, unknowns, problem.cortex.rest_stretch);
  const SurfaceExtremes surface = surface_extremes(problem, stretch);
  r.min_meridional_stretch = stretch.col(0).minCoeff();
  // Incompressible: the normal stretch is 1 / (least greatest).
  r.biot_ratio = (stretch.col(0).array().square() * stretch.col(1).array()).minCoeff();
  r.stability_margin = rheocyte::stability_margin(problem, problem.radius_ratio, surface);
  r.min_tension = surface.min_tension;
  if (const int p = space.inner_pressure(); p >= 0)
    r.inner_pressure = unknowns(p) + rest_pressure(problem.cortex, problem.radius_ratio);
  read_turning(*this, unknowns, r);
  return r;
}

void DuctDiscrete::describe(const Problem& problem, const VectorXd& unknowns, StationaryState& r) const {
  const DuctSpace& space = this->space();
  const CellVolume volume = cell_volume(space, system_->element(), unknowns);
  for (const auto& [name, camera] : views_of(problem))
    r.views.push_back({name, profile(space, unknowns, problem.cortex, camera, volume.barycentre)});
  const Camera seen_from = camera_in_mesh(problem);
  r.surface = profile(space, unknowns, problem.cortex, seen_from, volume.barycentre);
  r.contour = contour(problem, unknowns);
  shift(-volume.barycentre, r.contour);
  r.contour_places = space.mesh().surface_places();
  if (space.turns()) {
    r.offset_outline = duct_offset_outline(space, unknowns);
    r.offset_outline.rowwise() += Eigen::RowVector2d(-volume.barycentre, space.aside());
  }
  static_cast<StateNumbers&>(r) = numbers(problem, unknowns);
  r.statistics.unknowns = space.unknowns();
  r.statistics.elements = int(space.elements().size());
  r.statistics.degree = resolution().degree;
  const Media media = problem;
  r.write_fields = [shared = space_, media, unknowns](const std::string& path, const Scales& scales) {
    return write_fields(DuctFields(*shared, media, unknowns, scales), path);
  };
  r.sample_fields = [shared = space_, media, unknowns, camera = problem.camera, barycentre = volume.barycentre](
                        const Scales& scales, int points) {
    SampledFields fields = DuctFields(*shared, media, unknowns, scales).sample(camera, points);
    const auto place = float(scales.length_um() * barycentre);
    fields.point_um.col(0).array() -= place;
    fields.surface_um.col(0).array() -= place;
    return fields;
  };
}

}  // namespace rheocyte
