#include "solve/duct.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "case/scales.h"
#include "duct/cell_moments.h"
#include "duct/duct_ends.h"
#include "duct/duct_fields.h"
#include "fem/write_fields.h"
#include "laws/surface_form.h"
#include "shape/outline_shape.h"
#include "solve/surface_stability.h"

namespace rheocyte {
namespace {

Camera camera_in_mesh(const Problem& problem) { return problem.offset == 0 ? problem.camera : Camera{90}; }

/// Whether the walls along the height are straight and the others are not.
bool is_planar_funnel(const Problem& problem) { return !problem.wall.is_straight() && is_duct(problem.section); }

/// Whether the channel looks alike along width and height.
bool is_square(const Problem& problem) { return problem.section != Section::rectangle && !is_planar_funnel(problem); }

/// Cameras whose silhouettes are told of every state with a centred cell.
std::vector<std::pair<std::string_view, Camera>> views_of(const Problem& problem) {
  if (problem.offset != 0) return {};
  std::vector<std::pair<std::string_view, Camera>> views{{"side", Camera::side}};
  if (is_square(problem)) views.emplace_back("diagonal", Camera::diagonal);
  if (!is_square(problem)) views.emplace_back("across", Camera::along_width);
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

/// Of a centred cell in a straight duct. The narrower the gap the more elements along its side; a higher degree costs
/// more than these. The rear rim of a soft cell is sharp, and a higher degree makes it wavy
/// (docs/theory-square.md, sec. "Discretisation").
DuctSubdivision subdivision_for(double radius_ratio) {
  if (radius_ratio <= 0.65) return {.along = 4, .growth = 2};
  if (radius_ratio <= 0.88) return {.along = 5, .growth = 1.5};
  return {.along = radius_ratio <= 0.92 ? 6 : 8};
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

/// A cell off the axis keeps about its fraction of a width that changes, and the mesh is that of the narrow part.
double offset_in_mesh(const Problem& problem, double half_width) {
  if (problem.wall.is_straight()) return problem.offset;
  const double most = max_offset(half_width, problem.radius_ratio);
  return std::clamp(problem.offset / WallProfile(problem.wall).radius(0), -most, most);
}

/// Spokes to the edge of the box must not lead below the cell where the wall slants, but soft cells, which the funnel
/// draws out, need a long box: by the fraction of the width at which a cell starts.
void shorten_box(double fraction, DuctShape& shape) {
  constexpr double least = 0.2, greatest = 0.5;
  const double usual = disturbed_half_length(shape.radius, shape.extent), r0 = shape.radius,
               way = std::clamp((std::abs(fraction) - least) / (greatest - least), 0.0, 1.0);
  shape.box = std::lerp(usual, r0 + 0.4, way);
  shape.edge = std::lerp(usual, 0.83 * r0, way);
}

}  // namespace

DuctShape shape_of(const Problem& problem) {
  // So far the wide part feels the cell, and the cell the places where the wall begins to narrow.
  constexpr double funnel_length = 14;
  DuctShape shape{problem.section, problem.radius_ratio, problem.extent, problem.channel_length};
  if (!problem.wall.is_straight()) shape.length = std::max(shape.length, funnel_length);
  shape.run_out = run_out(problem.wall);
  if (problem.offset == 0) return shape;
  // The mesh has the offset along y.
  shape.narrows_in_height = problem.camera == Camera::side;
  if (shape.narrows_in_height) std::swap(shape.extent.width, shape.extent.height);
  shape.offset = shape.narrows_in_height ? problem.offset : offset_in_mesh(problem, shape.extent.width);
  if (!problem.wall.is_straight() && !shape.narrows_in_height)
    shorten_box(problem.offset / WallProfile(problem.wall).radius(0), shape);
  return shape;
}

Symmetry symmetry_of(const Problem& problem) {
  if (problem.offset != 0) return Symmetry::half;
  return is_planar_funnel(problem) ? Symmetry::quarter : symmetry_of(problem.section);
}

DuctSubdivision subdivision_of(const Problem& problem) {
  constexpr int axial_in_funnel = 4;
  if (problem.wall.is_straight())
    return problem.offset == 0 ? subdivision_for(problem.radius_ratio) : DuctSubdivision{.along = 2, .across = 2};
  if (problem.offset == 0) return {.along = 4, .axial = axial_in_funnel};
  return {.along = 2, .axial = axial_in_funnel, .across = 4};
}

DuctDiscrete::DuctDiscrete(const Problem& problem, const DuctSubdivision& subdivision, int degree, Symmetry symmetry)
    : Discrete({{}, degree}),
      subdivision_(subdivision),
      symmetry_(symmetry),
      space_(make_space(problem)),
      system_(make_system(problem)) {}

std::shared_ptr<DuctSpace> DuctDiscrete::make_space(const Problem& problem) const {
  return std::make_shared<DuctSpace>(DuctMesh(DuctGeometry(shape_of(problem)), subdivision_, symmetry_),
                                     resolution().degree, problem.liquid, problem.drive, interior_of(problem));
}

std::unique_ptr<DuctSystem> DuctDiscrete::make_system(const Problem& problem) const {
  const double drop = problem.drive == Drive::rate
                          ? 1
                          : problem.pressure_gradient / space().section().flow(problem.liquid).pressure_gradient;
  return std::make_unique<DuctSystem>(space(), drop, problem.cortex.bending > 0);
}

void DuctDiscrete::move_to(const Problem& problem) {
  const auto former_space = std::exchange(space_, make_space(problem));
  const auto former = std::exchange(system_, make_system(problem));
  system_->exchange_factors(*former);
}

VectorXd DuctDiscrete::transfer_from(const Discrete& other, const VectorXd& unknowns) const {
  return transfer(static_cast<const DuctDiscrete&>(other).space(), unknowns, space());
}

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
  if (problem.offset == 0) r.deformation_side = duct_deformation(space, unknowns, Camera::side);
  if (problem.offset == 0)
    r.deformation_across =
        is_square(problem) ? r.deformation_side : duct_deformation(space, unknowns, Camera::along_width);
  if (problem.offset == 0 && is_square(problem))
    r.deformation_diagonal = duct_deformation(space, unknowns, Camera::diagonal);
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

namespace {

/// The half of a cell off the axis has four times the unknowns of the eighth.
constexpr int last_degree = 7, last_degree_off_axis = 6;

std::shared_ptr<Discrete> duct_discrete(const Problem& problem, const Resolution& resolution) {
  return std::make_shared<DuctDiscrete>(problem, subdivision_of(problem), resolution.degree);
}

/// As in the tube (solve/tube.cc): layers and elements at the ends depend on the radius.
bool have_same_mesh(const Problem& a, const Problem& b, const Resolution&) {
  const auto elements = [](const Problem& problem) {
    return DuctMesh(DuctGeometry(shape_of(problem)), subdivision_of(problem), symmetry_of(problem)).elements();
  };
  return subdivision_of(a) == subdivision_of(b) &&
         std::ranges::equal(elements(a), elements(b), {}, &DuctElement::part, &DuctElement::part);
}

}  // namespace

/// A tangent takes the scout a third of the time that it takes at degree 3. Higher degrees move the end of a branch by
/// a few per cent: where it is farther from the wanted compliance than 15 %, they are not tried.
///
/// A deformation changes by about as much, relative, as the residual that is left: far less than the wanted accuracy. A
/// factorisation costs as much as tens of chord steps at high degrees. From one degree to the next, or to a nearby
/// case, a state takes one to three; beyond the end of the branch Newton wanders. Off the axis it takes more in
/// strongly shear-thinning liquids, whose viscosity is the least smooth where the cell no longer covers the axis.
///
/// A degree more costs three times as much here, and less caution than in the tube has to do (eq:square-error). Of a
/// centred cell the error at degree 4 is below the greatest of 0.4 of the change from degree 3, of 6e-4, by which the
/// two may agree by chance, and, in shear-thinning liquids, of 0.1 of the change of the stability margin m times
/// (1 - m)^2, by which the change counts the more the nearer the limit is. Where less is asked the first state is that
/// of degree 2, and the error at degree 3 below the greater of 0.2 of the change and 4e-3 (docs/verification.md, "The
/// stated error").
Geometry duct_geometry(const Problem& problem) {
  constexpr double rough = 5e-3;
  const bool is_centred = problem.offset == 0, is_rough = is_centred && problem.accuracy >= rough;
  const NewtonOptions on_the_way{.tolerance = 1e-7};
  Geometry duct{.make = duct_discrete, .is_alike = have_same_mesh};
  duct.ways = {{{{}, 2}, !is_rough}, {{{}, 3}}, {{{}, 4}}, {{{}, 5}}};
  duct.along = duct.across = on_the_way;
  duct.along.iteration_limit = 6;
  duct.min_step_before_refining = 0.03;
  duct.min_step_at_last = 5e-3;
  duct.gain_of_finer = 1 / 0.85;

  duct.rungs = {{{}, is_rough ? 2 : 3, is_centred ? last_degree : last_degree_off_axis}};
  // So that what single precision leaves of the last step is rounding, too; 2 to 4 % of the time.
  duct.fine = {.tolerance = 1e-10, .iteration_limit = is_centred ? 5 : 12, .chord_reduction = 0.5};
  duct.begins_with_way = true;
  duct.adds_lower_change = true;
  duct.errors = {.fraction_of_change_before = 0.1, .min_of_two = 6e-4};
  if (is_rough) {
    duct.errors.fraction_of_first_change = 0.2;
    duct.errors.min_of_two = 4e-3;
  } else if (is_centred) {
    duct.errors.fraction_of_first_change = 0.4;
    if (problem.liquid.law != LiquidLaw::newtonian) duct.errors.fraction_of_margin = 0.1;
  } else {
    duct.errors.fraction_of_outline = 0.2;
  }
  return duct;
}

}  // namespace rheocyte
