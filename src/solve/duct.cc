#include "solve/duct.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "case/scales.h"
#include "duct/duct_integrals.h"
#include "duct/duct_transfer.h"
#include "duct/fit_duct.h"
#include "fem/carry_liquid.h"

namespace rheocyte {
namespace {

/// Of a centred cell in a straight duct. The narrower the gap the more elements along its side; a higher degree costs
/// more than these. The rear rim of a soft cell is sharp, and a higher degree makes it wavy
/// (docs/theory-square.md, sec. "Discretisation").
DuctSubdivision subdivision_for(double radius_ratio) {
  if (radius_ratio <= 0.65) return {.along = 4, .growth = 2};
  if (radius_ratio <= 0.88) return {.along = 5, .growth = 1.5};
  return {.along = radius_ratio <= 0.92 ? 6 : 8};
}

/// A cell off the axis keeps about its fraction of a width that changes, and the mesh is that of the narrow part.
double offset_in_mesh(const Problem& problem, double half_width) {
  if (problem.wall.is_straight()) return problem.offset;
  const double most = max_offset(half_width, problem.radius_ratio);
  return std::clamp(problem.offset / WallProfile(problem.wall).radius(0), -most, most);
}

/// Spokes to the edge of the box must not lead below the cell where the wall slants, but soft cells, which the funnel
/// elongates, need a long box: by the fraction of the width at which a cell starts.
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
  // In a funnel the walls along the height are straight, and the others are not.
  return !problem.wall.is_straight() && is_duct(problem.section) ? Symmetry::quarter : symmetry_of(problem.section);
}

DuctSubdivision subdivision_of(const Problem& problem) {
  constexpr int axial_in_funnel = 4;
  if (problem.wall.is_straight())
    return problem.offset == 0 ? subdivision_for(problem.radius_ratio) : DuctSubdivision{.along = 2, .across = 2};
  if (problem.offset == 0) return {.along = 4, .axial = axial_in_funnel};
  return {.along = 2, .axial = axial_in_funnel, .across = 4};
}

DuctDiscrete::DuctDiscrete(const Problem& problem, const DuctSubdivision& subdivision, const Resolution& resolution,
                           Symmetry symmetry, const std::vector<double>& side_breaks)
    : Discrete(resolution),
      problem_(problem),
      subdivision_(subdivision),
      symmetry_(symmetry),
      space_(make_space(problem, side_breaks)),
      system_(make_system(problem)) {}

std::shared_ptr<DuctSpace> DuctDiscrete::make_space(const Problem& problem,
                                                    const std::vector<double>& side_breaks) const {
  return std::make_shared<DuctSpace>(DuctMesh(DuctGeometry(shape_of(problem)), subdivision_, symmetry_, side_breaks),
                                     resolution().degree, problem.liquid, problem.drive, interior_of(problem));
}

std::unique_ptr<DuctSystem> DuctDiscrete::make_system(const Problem& problem) const {
  const double drop = problem.drive == Drive::rate
                          ? 1
                          : problem.pressure_gradient / space().section().flow(problem.liquid).pressure_gradient;
  return std::make_unique<DuctSystem>(space(), drop, problem.cortex.bending > 0);
}

void DuctDiscrete::move_to(const Problem& problem) {
  const auto former_space = std::exchange(space_, make_space(problem, space().mesh().side_breaks()));
  problem_ = problem;
  if (is_fitted()) space().set_points(transferred_points(*former_space, space()));
  const auto former = std::exchange(system_, make_system(problem));
  system_->exchange_factors(*former);
}

namespace {

/// Of a centred cell with a bent surface, which is dented with a sharp rim: the side's elements are moved to where the
/// rim is, and the bulk below it is resolved.
constexpr Subdivision at_rims{.top = 6, .ring = 2}, finer_at_rims{.top = 8, .ring = 2};

bool sees_rims(const Resolution& resolution) {
  return resolution.subdivision == at_rims || resolution.subdivision == finer_at_rims;
}

DuctSubdivision subdivision_at(const Problem& problem, const Resolution& resolution) {
  DuctSubdivision n = subdivision_of(problem);
  if (!sees_rims(resolution)) return n;
  n.along = std::max(n.along, resolution.subdivision.top);
  if (interior_of(problem) == Interior::elastic) n.ring = resolution.subdivision.ring;
  return n;
}

}  // namespace

double DuctDiscrete::mesh_quality(const VectorXd& unknowns) const { return liquid_mesh_quality(space(), unknowns); }

double DuctDiscrete::surface_evenness(const VectorXd& unknowns) const {
  return sees_rims(resolution()) ? rheocyte::surface_evenness(space(), unknowns) : 1;
}

std::shared_ptr<DuctDiscrete> DuctDiscrete::with(const std::vector<double>& side_breaks,
                                                 const DuctSpace& points_as) const {
  const auto made = std::make_shared<DuctDiscrete>(problem_, subdivision_, resolution(), symmetry_,
                                                   like(side_breaks, subdivision_.along));
  made->space().set_points(transferred_points(points_as, made->space()));
  return made;
}

std::shared_ptr<Discrete> DuctDiscrete::made_as(const Discrete& other) const {
  const DuctSpace& like_it = static_cast<const DuctDiscrete&>(other).space();
  return with(like_it.mesh().side_breaks(), like_it);
}

std::shared_ptr<Discrete> DuctDiscrete::cut_again(const VectorXd& unknowns, double evenly) const {
  return sees_rims(resolution()) ? with(fitted_breaks(space(), unknowns, evenly), space()) : nullptr;
}

void DuctDiscrete::fit(const VectorXd& unknowns) { space().set_points(fitted_points(space(), unknowns)); }

VectorXd DuctDiscrete::transfer_from(const Discrete& other, const VectorXd& unknowns) const {
  return transfer(static_cast<const DuctDiscrete&>(other).space(), unknowns, space());
}

VectorXd DuctDiscrete::carry_from(const Discrete& other, const VectorXd& unknowns) const {
  VectorXd carried = transfer_from(other, unknowns);
  carry_liquid(static_cast<const DuctDiscrete&>(other).space(), unknowns, space(), carried);
  return carried;
}

namespace {

/// The half of a cell off the axis has four times the unknowns of the eighth.
constexpr int last_degree = 7, last_degree_off_axis = 6;

std::shared_ptr<Discrete> duct_discrete(const Problem& problem, const Resolution& resolution) {
  const DuctSubdivision n = subdivision_at(problem, resolution);
  return std::make_shared<DuctDiscrete>(problem, n, resolution, symmetry_of(problem), side_breaks(n));
}

/// As in the tube (solve/tube.cc): layers and elements at the ends depend on the radius.
bool have_same_mesh(const Problem& a, const Problem& b, const Resolution& resolution) {
  const auto elements = [&](const Problem& problem) {
    return DuctMesh(DuctGeometry(shape_of(problem)), subdivision_at(problem, resolution), symmetry_of(problem))
        .elements();
  };
  return subdivision_at(a, resolution) == subdivision_at(b, resolution) &&
         std::ranges::equal(elements(a), elements(b), {}, &DuctElement::part, &DuctElement::part);
}

/// The way leaves the coarse mesh where the cell is so dented that this is worn again after it was fitted.
void follow_rims(Geometry& duct) {
  constexpr int degree = 3, last = 5;
  constexpr double never_hopeless = 100;
  std::erase_if(duct.ways, [](const CoarseWay& way) { return way.resolution.degree > degree; });
  for (CoarseWay& way : duct.ways) way.fits = Fits::once;
  for (const Subdivision& subdivision : {at_rims, finer_at_rims}) duct.ways.push_back({{subdivision, degree}});
  duct.rungs.front().is_rough_at_rims = true;
  duct.rungs.push_back({.subdivision = at_rims, .first_degree = degree, .last_degree = degree, .goes_on = true});
  duct.rungs.push_back({.subdivision = finer_at_rims, .first_degree = degree, .last_degree = last, .goes_on = true});
  duct.min_step_before_refining = duct.min_step_at_last;
  duct.gain_of_finer = never_hopeless;
}

}  // namespace

/// A tangent takes the scout a third of the time that it takes at degree 3. Higher degrees move the end of a branch by
/// a few per cent: where it is farther from the requested compliance than 15 %, they are not tried.
///
/// A deformation changes by about as much, relative, as the residual that is left: far less than the requested
/// accuracy. A factorisation costs as much as tens of chord steps at high degrees. From one degree to the next, or to a
/// nearby case, a state takes one to three; beyond the end of the branch Newton wanders. Off the axis it takes more in
/// strongly shear-thinning liquids, whose viscosity is the least smooth where the cell no longer covers the axis.
///
/// A degree more costs three times as much here, and less caution than in the tube has to do (eq:square-error). Of a
/// centred cell the error at degree 4 is below the greatest of 0.4 of the change from degree 3, of 6e-4, by which the
/// two may agree by chance, and, in shear-thinning liquids, of 0.1 of the change of the stability margin m times
/// (1 - m)^2, by which the change counts the more the nearer the limit is. Where less is asked the first state is that
/// of degree 2, and the error at degree 3 below the greater of 0.2 of the change, 0.4 where the rim may be sharp, and
/// 4e-3 (docs/verification.md, "The stated error").
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
  if (problem.cortex.bending > 0) {  // a sharp rim, as in the tube
    duct.climbs_anew = true;
    duct.fine.iteration_limit = duct.along.iteration_limit = 12;
    duct.fine.tolerance = 1e-8;
  }
  duct.adds_lower_change = true;
  duct.errors = {.fraction_of_change_before = 0.1, .min_of_two = 6e-4};
  if (is_rough) {
    duct.errors.fraction_of_first_change = problem.cortex.bending > 0 ? 0.4 : 0.2;
    duct.errors.min_of_two = 4e-3;
  } else if (is_centred) {
    duct.errors.fraction_of_first_change = 0.4;
    if (problem.liquid.law != LiquidLaw::newtonian) duct.errors.fraction_of_margin = 0.1;
  } else {
    duct.errors.fraction_of_outline = 0.2;
  }
  if (problem.cortex.bending > 0 && is_centred) follow_rims(duct);
  return duct;
}

}  // namespace rheocyte
