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

Spacing spacing_for(const Liquid& liquid) { return thinning(liquid) == 0 ? Spacing::even : Spacing::by_shear; }

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
  // Tension and moduli are those of the media, which may be on the way to the requested ones.
  r.stability_margin =
      stability_margin(state.problem, state.problem.radius_ratio,
                       {least_along(surface, wrinkling_margins(state.problem.bulk, surface)), r.min_tension,
                        least_along(surface, collapse_margins(state.problem, surface))});
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

}  // namespace rheocyte
