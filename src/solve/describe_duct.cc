#include "solve/describe_duct.h"

#include <cmath>
#include <numbers>

#include "duct/duct_ends.h"
#include "duct/sample_duct_fields.h"
#include "duct/write_duct_fields.h"
#include "fem/observe.h"

namespace rheocyte {
namespace {

/// Cameras whose silhouettes are told of every state.
std::vector<std::pair<std::string_view, Camera>> views_of(Section section) {
  std::vector<std::pair<std::string_view, Camera>> views{{"side", Camera::side}};
  if (section != Section::rectangle) views.emplace_back("diagonal", Camera::diagonal);
  return views;
}

/// Moves along the flow.
void shift(double by, Contour& contour) {
  for (CurvePiece& piece : contour.pieces) piece.col(0).array() += by;
}

/// The surface along a silhouette; without a cortex there is no tension.
SurfaceProfile profile(const DuctSpace& space, const VectorXd& unknowns, Camera camera, double barycentre) {
  const DuctMeridian meridian =
      duct_meridian(space, unknowns, camera, VectorXd::LinSpaced(SurfaceProfile::points_per_piece, 0, 1));
  SurfaceProfile profile{meridian.rest_angle, meridian.point, meridian.stretch,
                         Eigen::MatrixX2d::Zero(meridian.point.rows(), 2), meridian.curvature};
  profile.point.col(0).array() -= barycentre;
  return profile;
}

/// Of principal stretches, the least first. Incompressible: the normal stretch is 1 / (least greatest).
double biot_ratio(const Eigen::MatrixX2d& stretch) {
  return (stretch.col(0).array().square() * stretch.col(1).array()).minCoeff();
}

double margin_of(double ratio) { return (ratio - biot_limit) / (1 - biot_limit); }

void read_flow(const Media& media, DuctDiscrete& discrete, const VectorXd& unknowns, StateNumbers& r) {
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
  r.shear_rate_max = greatest_shear_rate(discrete.space, discrete.system.element(), unknowns);
}

}  // namespace

double duct_deformation(const DuctSpace& space, const VectorXd& unknowns, Camera camera) {
  return measure(duct_contour(space, unknowns, camera)).deformation;
}

double duct_stability_margin(const DuctSpace& space, const VectorXd& unknowns) {
  return margin_of(biot_ratio(duct_principal_stretches(space, unknowns)));
}

void describe_duct(const Problem& problem, const Media& media, const std::shared_ptr<DuctDiscrete>& discrete,
                   const VectorXd& unknowns, StationaryState& r) {
  const DuctSpace& space = discrete->space;
  const CellVolume volume = cell_volume(space, discrete->system.element(), unknowns);
  for (const auto& [name, camera] : views_of(problem.section))
    r.views.push_back({name, profile(space, unknowns, camera, volume.barycentre)});
  r.surface = profile(space, unknowns, problem.camera, volume.barycentre);
  const auto contour_at = [&](Camera camera) {
    Contour contour = duct_contour(space, unknowns, camera);
    shift(-volume.barycentre, contour);
    return contour;
  };
  r.contour = contour_at(problem.camera);

  r.shape = measure(r.contour);
  r.volume_of_revolution = r.shape.volume;
  r.shape.volume = volume.volume;
  r.deformation_side = measure(contour_at(Camera::side)).deformation;
  if (problem.section != Section::rectangle) r.deformation_diagonal = measure(contour_at(Camera::diagonal)).deformation;
  const double a = space.mesh().geometry().radius();
  r.relative_volume_change = volume.volume / (4.0 / 3 * std::numbers::pi * a * a * a) - 1;
  read_flow(media, *discrete, unknowns, r);
  const Eigen::MatrixX2d stretch = duct_principal_stretches(space, unknowns);
  r.least_meridional_stretch = stretch.col(0).minCoeff();
  r.biot_ratio = biot_ratio(stretch);
  r.stability_margin = margin_of(r.biot_ratio);
  r.least_tension = 0;
  r.statistics.unknowns = space.unknowns();
  r.statistics.elements = int(space.elements().size());
  r.statistics.degree = space.reference().degree();
  r.write_fields = [discrete, media, unknowns](const std::string& path, const Scales& scales) {
    return write_duct_fields(discrete->space, media, unknowns, scales, path);
  };
  r.sample_fields = [=, camera = problem.camera](const Scales& scales, int points) {
    SampledFields fields = sample_duct_fields(discrete->space, media, unknowns, scales, camera, points);
    const auto place = float(1e6 * scales.length_m * volume.barycentre);
    fields.point_um.col(0).array() -= place;
    fields.surface_um.col(0).array() -= place;
    return fields;
  };
}

}  // namespace rheocyte
