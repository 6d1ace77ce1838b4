#include "solve/tube.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "fem/carry_liquid.h"
#include "fem/element_integrals.h"
#include "fem/end_loads.h"
#include "fem/fit_liquid.h"
#include "fem/tube_fields.h"
#include "fem/write_fields.h"
#include "laws/developed_flow.h"
#include "numeric/parabola.h"
#include "solve/surface_stability.h"

namespace rheocyte {
namespace {

Spacing spacing_for(const Liquid& liquid) { return thinning(liquid) == 0 ? Spacing::even : Spacing::by_shear; }

void read_flow(const StateView& state, StateNumbers& r) {
  const ChannelGeometry& geometry = state.space.mesh().geometry();
  const double half = geometry.half_length();
  r.cell_velocity = state.unknowns(state.space.cell_velocity());
  r.reynolds = state.problem.liquid.reynolds * r.cell_velocity;
  r.channel_length = 2 * half;
  // Where the mesh ends the pressure is given.
  const double outlet = geometry.end() == half ? -undisturbed_inlet_pressure(state.space, state.problem.liquid)
                                               : end_pressure(state.space, state.unknowns, ChannelEnd::downstream);
  r.pressure_drop = end_pressure(state.space, state.unknowns, ChannelEnd::upstream) - outlet;
  r.flow_rate = flow_rate(state.space, state.unknowns);
  r.volume_flow = std::numbers::pi * r.flow_rate;
  const double undisturbed = undisturbed_pressure_gradient(state.problem.liquid, r.flow_rate) * r.channel_length;
  if (state.problem.wall.is_straight()) r.additional_pressure_drop = r.pressure_drop - undisturbed;
  if (const int p = state.space.inner_pressure(); p >= 0)
    r.inner_pressure = state.unknowns(p) + rest_pressure(state.problem.cortex, state.problem.radius_ratio);
}

/// 2 D:D in U/R squared at the quadrature points of an element of the liquid, the first coordinate along the columns.
MatrixXd squared_shear_rates(const std::vector<LiquidFields<double, 2>>& fields, Eigen::Index points_1d) {
  MatrixXd squares(points_1d, points_1d);
  Eigen::Index q = 0;
  for (const auto& f : fields) {
    const Tensor<double> L = gradient(PointMap<double, 2>(f.map), f.w, f.w_xi);
    squares(q % points_1d, q / points_1d) = 0.5 * (L + L.transpose()).squaredNorm();
    ++q;
  }
  return squares;
}

/// Axial coordinates of the element's nodes, arranged alike.
MatrixXd axial_coordinates(const StateView& state, int e) {
  const Eigen::Index n = state.space.reference().nodes_1d.size();
  return points_of_nodes(state.space, e, state.unknowns).col(0).reshaped(n, n);
}

/// The greatest value on a grid, and between its points: near it values go along parabolas in both directions. Zeros do
/// not count.
double greatest_of(const Eigen::ArrayXXd& values) {
  Eigen::Index i = 0, j = 0;
  const double at = values.maxCoeff(&i, &j);
  const auto beyond = [&](const auto& line, Eigen::Index k) {
    const bool is_inside = k > 0 && k + 1 < line.size() && line(k - 1) > 0 && line(k + 1) > 0;
    return is_inside ? vertex(line(k - 1), at, line(k + 1)) - at : 0;
  };
  return at + beyond(values.col(j), i) + beyond(values.row(i), j);
}

/// The same of the points with x from `rear` to `front`, and where lines of the grid cross these planes.
double greatest_between(double rear, double front, const Eigen::ArrayXXd& x, const Eigen::ArrayXXd& values) {
  const auto is_inside = [&](double at) { return at >= rear && at <= front; };
  double greatest = greatest_of((x >= rear && x <= front).select(values, 0));
  const auto look = [&](double x1, double value1, double x2, double value2) {
    if (is_inside(x1) == is_inside(x2)) return;
    const double plane = std::max(x1, x2) > front ? front : rear, t = (plane - x1) / (x2 - x1);
    greatest = std::max(greatest, (1 - t) * value1 + t * value2);
  };
  for (Eigen::Index j = 0; j < x.cols(); ++j) {
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
      if (i > 0) look(x(i - 1, j), values(i - 1, j), x(i, j), values(i, j));
      if (j > 0) look(x(i, j - 1), values(i, j - 1), x(i, j), values(i, j));
    }
  }
  return greatest;
}

/// The greatest shear rate between the planes through the cell's poles. Quadrature points lie neither on the cell nor
/// at the wall, where it is the greatest: the polynomials that fit 2 D:D best there are looked at up to the edges.
double max_shear_rate(const StateView& state, const Contour& contour) {
  const ReferenceElement<2>& reference = state.space.reference();
  const VectorXd grid = VectorXd::LinSpaced(4 * reference.degree() + 1, 0, 1);
  const MatrixXd nodes_to_grid = reference.lagrange(grid), points_to_grid = nodes_to_grid * reference.points_to_nodes();
  const double front = contour.pieces.front()(0, 0), rear = contour.pieces.back()(contour.pieces.back().rows() - 1, 0);
  double greatest = 0;
  for (int e = 0; e < int(state.space.elements().size()); ++e) {
    if (!state.space.elements()[e].liquid) continue;
    const MatrixXd nodes = axial_coordinates(state, e);
    if (nodes.minCoeff() > front || nodes.maxCoeff() < rear) continue;
    const auto fields = fields_at_points<LiquidFields<double, 2>>(state.space, e, state.unknowns);
    const MatrixXd squares = squared_shear_rates(fields, reference.points_1d.size());
    const Eigen::ArrayXXd x = nodes_to_grid * nodes * nodes_to_grid.transpose(),
                          rate = points_to_grid * squares * points_to_grid.transpose();
    greatest = std::max(greatest, greatest_between(rear, front, x, rate));
  }
  return std::sqrt(greatest);
}

}  // namespace

StateNumbers numbers_of(const StateView& state, const Contour& contour, const SurfaceState& surface) {
  StateNumbers r;
  r.shape = measure(contour);
  r.volume_of_revolution = r.shape.volume;
  r.relative_volume_change =
      r.shape.volume / (4.0 / 3 * std::numbers::pi * std::pow(state.problem.radius_ratio, 3)) - 1;
  read_flow(state, r);
  r.shear_rate_max = max_shear_rate(state, contour);
  r.min_meridional_stretch = least_along(surface, surface.stretch.col(0));
  r.min_tension = least_along(surface, surface_tensions(state.problem.cortex, surface).col(0));
  r.biot_ratio = least_along(surface, biot_ratios(surface));
  // Tension and moduli are those of the media, which may be on the way to the wanted ones.
  r.stability_margin =
      stability_margin(state.problem, state.problem.radius_ratio,
                       {least_along(surface, wrinkling_margins(state.problem.bulk, surface)), r.min_tension});
  return r;
}

TubeDiscrete::Space::Space(const Problem& problem, const Resolution& resolution, const SurfaceBreaks& breaks)
    : mesh(std::make_shared<ChannelMesh>(geometry_of(problem), resolution.subdivision, breaks)),
      of_mesh(*mesh, resolution.degree, problem.liquid, interior_of(problem), problem.drive) {}

TubeDiscrete::TubeDiscrete(const Problem& problem, const Resolution& resolution)
    : TubeDiscrete(problem, resolution, surface_breaks(resolution.subdivision, spacing_for(problem.liquid))) {}

TubeDiscrete::TubeDiscrete(const Problem& problem, const Resolution& resolution, const SurfaceBreaks& breaks)
    : Discrete(resolution),
      problem_(problem),
      space_(std::make_shared<Space>(problem, resolution, breaks)),
      system_(space_->of_mesh) {}

void TubeDiscrete::move_to(const Problem& problem) {
  const auto former = std::exchange(space_, std::make_shared<Space>(problem, resolution(), space().mesh().breaks()));
  problem_ = problem;
  is_fitted() ? set_points(transferred_points(former->of_mesh, space())) : system_.follow_space(space());
}

void TubeDiscrete::set_points(const std::vector<Point>& points) {
  space().set_points(points);
  system_.follow_space(space());
}

double TubeDiscrete::mesh_quality(const VectorXd& unknowns) const { return liquid_mesh_quality(space(), unknowns); }

double TubeDiscrete::surface_evenness(const VectorXd& unknowns) const {
  return rheocyte::surface_evenness(space(), unknowns);
}

std::shared_ptr<TubeDiscrete> TubeDiscrete::with(const SurfaceBreaks& breaks, const Discretisation& points_as) const {
  const auto made =
      std::shared_ptr<TubeDiscrete>(new TubeDiscrete(problem_, resolution(), like(breaks, space().mesh().breaks())));
  made->set_points(transferred_points(points_as, made->space()));
  return made;
}

std::shared_ptr<Discrete> TubeDiscrete::made_as(const Discrete& other) const {
  const Discretisation& like_it = static_cast<const TubeDiscrete&>(other).space();
  return with(like_it.mesh().breaks(), like_it);
}

std::shared_ptr<Discrete> TubeDiscrete::cut_again(const VectorXd& unknowns, double evenly) const {
  return with(fitted_breaks(space(), unknowns, evenly), space());
}

void TubeDiscrete::fit(const VectorXd& unknowns) { set_points(fitted_points(space(), unknowns)); }

VectorXd TubeDiscrete::transfer_from(const Discrete& other, const VectorXd& unknowns) const {
  return transfer(static_cast<const TubeDiscrete&>(other).space(), unknowns, space());
}

VectorXd TubeDiscrete::carry_from(const Discrete& other, const VectorXd& unknowns) const {
  VectorXd carried = transfer_from(other, unknowns);
  carry_liquid(static_cast<const TubeDiscrete&>(other).space(), unknowns, space(), carried);
  return carried;
}

Contour TubeDiscrete::contour(const Problem&, const VectorXd& unknowns) const {
  return rheocyte::contour(space(), unknowns);
}

double TubeDiscrete::stability_margin(const Problem& problem, const VectorXd& unknowns) const {
  return rheocyte::stability_margin(problem, space(), unknowns);
}

bool TubeDiscrete::is_wrinkled(const Problem& problem, const VectorXd& unknowns) const {
  return rheocyte::is_wrinkled(problem, space(), unknowns);
}

namespace {

SurfaceState written_surface(const Problem& problem, const Discretisation& space, const VectorXd& unknowns) {
  return surface_state(space, unknowns, SurfaceProfile::points_per_piece, problem.bulk.rest_stretch);
}

}  // namespace

StateNumbers TubeDiscrete::numbers(const Problem& problem, const VectorXd& unknowns) const {
  return numbers_of({problem, space(), unknowns}, contour(problem, unknowns),
                    written_surface(problem, space(), unknowns));
}

void TubeDiscrete::describe(const Problem& problem, const VectorXd& unknowns, StationaryState& r) const {
  const SurfaceState surface = written_surface(problem, space(), unknowns);
  r.contour = contour(problem, unknowns);
  r.surface = {surface.angle, surface.point, surface.stretch, surface_tensions(problem.cortex, surface),
               surface.curvature};
  static_cast<StateNumbers&>(r) = numbers_of({problem, space(), unknowns}, r.contour, surface);
  r.statistics.unknowns = space().unknowns();
  r.statistics.elements = int(space().elements().size());
  r.statistics.degree = resolution().degree;
  const Media media = problem;
  r.write_fields = [shared = space_, media, unknowns](const std::string& path, const Scales& scales) {
    return write_fields(TubeFields(shared->of_mesh, media, unknowns, scales), path);
  };
  r.sample_fields = [shared = space_, media, unknowns](const Scales& scales, int points) {
    return sample_fields(TubeFields(shared->of_mesh, media, unknowns, scales), points);
  };
}

namespace {

constexpr Subdivision coarse{2, 4, 1, 2}, dense{2, 10, 1, 2}, densest{4, 10, 2, 2}, middle{3, 6, 1, 2},
    fine{4, 8, 2, 2};

/// Of Newton's method: what rounding leaves of the residual where a sharp rim is bent is up to 1e-9.
constexpr double of_bent_surface = 1e-8;

/// So much farther may a branch go on finer meshes that its coarse ends say nothing.
constexpr double never_hopeless = 100;

/// Above this r0 / R the liquid's film is so thin and long that the coarsest mesh is only compared with.
constexpr double narrow_gap = 0.85;

std::shared_ptr<Discrete> tube_discrete(const Problem& problem, const Resolution& resolution) {
  return std::make_shared<TubeDiscrete>(problem, resolution);
}

/// The layers of liquid depend on the radius, and so does whether the channel is longer than it need be, which takes an
/// element more.
bool have_same_elements(const Problem& a, const Problem& b, const Resolution& resolution) {
  const auto elements = [&](const Problem& problem) {
    return ChannelMesh(geometry_of(problem), resolution.subdivision, spacing_for(problem.liquid)).elements();
  };
  return spacing_for(a.liquid) == spacing_for(b.liquid) &&
         std::ranges::equal(elements(a), elements(b), {}, &MeshElement::block, &MeshElement::block);
}

}  // namespace

/// Coarse resolutions cost 3 ms per Newton iteration and mostly go all the way; near the end of the branch the rear
/// shoulder and the front tip need the fine ones, which went on by a fifth and by a few times the change between two of
/// the coarse ones. Intermediate states serve as starting points only.
Geometry tube_geometry(const Problem& problem) {
  const NewtonOptions on_the_way{.tolerance = 1e-7};
  Geometry tube{.make = tube_discrete, .is_alike = have_same_elements};
  tube.ways = {{{coarse, 4}}, {{coarse, 6}}, {{middle, 6}}, {{middle, 8}}};
  tube.along = tube.across = on_the_way;
  tube.along.iteration_limit = 5;
  tube.min_step_before_refining = 0.03;
  tube.min_step_at_last = 2e-3;
  tube.gain_of_finer = 1.2;
  tube.gain_by_change = 6;
  tube.margin_at_coarse_ends = 0.3;
  tube.ends_late_on_finer = true;
  tube.knows_ends = true;
  const bool is_narrow = problem.radius_ratio > narrow_gap;
  tube.rungs = {{coarse, 4, is_narrow ? 5 : 9, is_narrow, false, is_narrow},
                {middle, 7, 10, false, false, is_narrow},
                {fine, 7, 10, false, false, is_narrow}};
  tube.fine.tolerance = 1e-10;
  if (problem.cortex.bending > 0) {
    // The rim of a dented cell is sharp, wanders along the surface as the cell softens, and is seen by no coarse mesh.
    tube.ways = {{{coarse, 4}}, {{coarse, 6}}, {{dense, 6}}, {{dense, 8}}};
    Rungs first = tube.rungs.front(), second{.subdivision = dense, .first_degree = 6, .last_degree = 9};
    first.is_rough_at_rims = second.is_rough_at_rims = true;  // the bulk below a rim needs elements of its own
    second.goes_on = is_narrow;
    Rungs last = second;
    last.subdivision = densest;
    last.is_rough_at_rims = false;
    tube.rungs = {first, second, last};
    tube.min_step_before_refining = 3e-3;
    tube.gain_of_finer = never_hopeless;
    tube.along.iteration_limit = 8;
    tube.fine.tolerance = of_bent_surface;
  }
  tube.climbs_anew = true;
  tube.judges_rungs = true;
  tube.errors.fraction_of_inertia = 0.3;
  return tube;
}

}  // namespace rheocyte
