#include "solve/describe_duct.h"

#include <cmath>
#include <numbers>

#include "duct/sample_duct_fields.h"
#include "duct/write_duct_fields.h"
#include "fem/observe.h"

namespace rheocyte {
namespace {

/// Area of the section over the square of its half width, or of the radius.
double area_of(Section section) { return section == Section::square ? 4 : std::numbers::pi; }

/// Moves along the flow.
void shift(double by, Contour& contour) {
  for (CurvePiece& piece : contour.pieces) piece.col(0).array() += by;
  // Round-off must not put a pole beyond the axis.
  contour.pieces.front()(0, 1) = 0;
  contour.pieces.back()(contour.pieces.back().rows() - 1, 1) = 0;
}

/// The surface along a silhouette; without a cortex there is no tension.
SurfaceProfile profile(const DuctSpace& space, const VectorXd& unknowns, Camera camera, double barycentre) {
  const DuctMeridian meridian = duct_meridian(space, unknowns, camera, SurfaceProfile::points_per_piece);
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

void read_flow(const Problem& problem, const Media& media, DuctDiscrete& discrete, const VectorXd& unknowns,
               StateNumbers& r) {
  const double half = discrete.space.mesh().geometry().half_length();
  const double gradient = discrete.system.undisturbed_gradient(media.liquid);
  r.cell_velocity = unknowns(discrete.space.cell_velocity());
  r.reynolds = media.liquid.reynolds * r.cell_velocity;
  r.channel_length = 2 * half;
  r.pressure_drop = duct_inlet_pressure(discrete.space, unknowns) + gradient * half;
  r.additional_pressure_drop = r.pressure_drop - 2 * gradient * half;
  r.flow_rate = 1;
  r.volume_flow = area_of(problem.section);
  r.tube_radius = no_value;
  r.shear_rate_max = greatest_shear_rate(discrete.space, discrete.system.element(), unknowns);
}

}  // namespace

double duct_deformation(const DuctSpace& space, const VectorXd& unknowns, Camera camera) {
  Contour contour = duct_contour(space, unknowns, camera);
  shift(0, contour);
  return measure(contour).deformation;
}

double duct_stability_margin(const DuctSpace& space, const VectorXd& unknowns) {
  return margin_of(biot_ratio(duct_principal_stretches(space, unknowns)));
}

void describe_duct(const Problem& problem, const Media& media, const std::shared_ptr<DuctDiscrete>& discrete,
                   const VectorXd& unknowns, StationaryState& r) {
  const DuctSpace& space = discrete->space;
  const CellVolume volume = cell_volume(space, discrete->system.element(), unknowns);
  for (const Camera camera : {Camera::side, Camera::diagonal})
    r.views[std::size_t(camera)] = profile(space, unknowns, camera, volume.barycentre);
  r.surface = r.views[std::size_t(problem.camera)];
  const auto contour_at = [&](Camera camera) {
    Contour contour = duct_contour(space, unknowns, camera);
    shift(-volume.barycentre, contour);
    return contour;
  };
  const auto deformation_at = [&](Camera camera) { return measure(contour_at(camera)).deformation; };
  r.contour = contour_at(problem.camera);

  r.shape = measure(r.contour);
  r.volume_of_revolution = r.shape.volume;
  r.shape.volume = volume.volume;
  r.deformation_side = deformation_at(Camera::side);
  r.deformation_diagonal = deformation_at(Camera::diagonal);
  const double a = space.mesh().geometry().radius();
  r.relative_volume_change = volume.volume / (4.0 / 3 * std::numbers::pi * a * a * a) - 1;
  read_flow(problem, media, *discrete, unknowns, r);
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
