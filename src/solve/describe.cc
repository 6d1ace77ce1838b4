#include "solve/describe.h"

#include <cmath>
#include <numbers>

#include "fem/observe.h"
#include "fem/write_fields.h"
#include "solve/surface_stability.h"

namespace rheocyte {
namespace {

void describe_surface(const Problem& problem, const DiscreteState& state, StationaryState& r) {
  const SurfaceState surface = surface_state(state.discrete->space, state.unknowns, SurfaceProfile::points_per_piece);
  const Eigen::MatrixX2d tension = surface_tensions(state.media.cortex, surface);
  r.surface = {surface.angle, surface.point, surface.stretch, tension, surface.curvature};
  r.least_meridional_stretch = surface.stretch.col(0).minCoeff();
  r.least_tension = tension.col(0).minCoeff();
  r.biot_ratio = least_biot_ratio(surface);
  r.stability_margin = stability_margin(problem, surface);
}

}  // namespace

void describe_state(const Problem& problem, const DiscreteState& state, StationaryState& r) {
  const Discretisation& space = state.discrete->space;
  r.contour = contour(space, state.unknowns);
  r.shape = measure(r.contour);
  r.cell_velocity = state.unknowns(space.cell_velocity());
  const double half = space.mesh().geometry().half_length();
  const double gradient = undisturbed_pressure_gradient(state.media.liquid);
  r.channel_length = 2 * half;
  r.pressure_drop = inlet_pressure(space, state.unknowns) + gradient * half;
  r.flow_rate = flow_rate(space, state.unknowns);
  const double undisturbed = gradient * std::pow(r.flow_rate, state.media.liquid.exponent) * r.channel_length;
  if (problem.wall.is_straight()) r.additional_pressure_drop = r.pressure_drop - undisturbed;
  r.relative_volume_change = r.shape.volume / (4.0 / 3 * std::numbers::pi * std::pow(problem.radius_ratio, 3)) - 1;
  describe_surface(problem, state, r);
  if (const int p = space.inner_pressure(); p >= 0)
    r.inner_pressure = state.unknowns(p) + 2 * state.media.cortex.tension / problem.radius_ratio;
  r.statistics.unknowns = space.unknowns();
  r.statistics.elements = int(space.elements().size());
  r.write_fields = [state](const std::string& path, const Scales& scales) {
    return write_fields(state.discrete->space, state.media, state.unknowns, scales, path);
  };
}

}  // namespace rheocyte
