#include "solve/describe.h"

#include <cmath>
#include <numbers>

#include "fem/write_fields.h"
#include "solve/surface_stability.h"

namespace rheocyte {
namespace {

void read_flow(const StateView& state, StateNumbers& r) {
  const double half = state.space.mesh().geometry().half_length();
  const double gradient = undisturbed_pressure_gradient(state.media.liquid);
  r.cell_velocity = state.unknowns(state.space.cell_velocity());
  r.reynolds = state.media.liquid.reynolds * r.cell_velocity;
  r.channel_length = 2 * half;
  r.pressure_drop = inlet_pressure(state.space, state.unknowns) + gradient * half;
  r.flow_rate = flow_rate(state.space, state.unknowns);
  const double undisturbed = gradient * std::pow(r.flow_rate, state.media.liquid.exponent) * r.channel_length;
  if (state.problem.wall.is_straight()) r.additional_pressure_drop = r.pressure_drop - undisturbed;
  if (const int p = state.space.inner_pressure(); p >= 0)
    r.inner_pressure = state.unknowns(p) + 2 * state.media.cortex.tension / state.problem.radius_ratio;
}

}  // namespace

StateNumbers numbers_of(const StateView& state, const Contour& contour, const SurfaceState& surface) {
  StateNumbers r;
  r.shape = measure(contour);
  r.relative_volume_change =
      r.shape.volume / (4.0 / 3 * std::numbers::pi * std::pow(state.problem.radius_ratio, 3)) - 1;
  read_flow(state, r);
  r.least_meridional_stretch = surface.stretch.col(0).minCoeff();
  r.least_tension = surface_tensions(state.media.cortex, surface).col(0).minCoeff();
  r.biot_ratio = least_biot_ratio(surface);
  r.stability_margin = stability_margin(state.problem, surface);
  return r;
}

void describe_state(const Problem& problem, const DiscreteState& state, StationaryState& r) {
  const Discretisation& space = state.discrete->space;
  const SurfaceState surface = surface_state(space, state.unknowns, SurfaceProfile::points_per_piece);
  r.contour = contour(space, state.unknowns);
  r.surface = {surface.angle, surface.point, surface.stretch, surface_tensions(state.media.cortex, surface),
               surface.curvature};
  static_cast<StateNumbers&>(r) = numbers_of({problem, state.media, space, state.unknowns}, r.contour, surface);
  r.statistics.unknowns = space.unknowns();
  r.statistics.elements = int(space.elements().size());
  r.write_fields = [state](const std::string& path, const Scales& scales) {
    return write_fields(state.discrete->space, state.media, state.unknowns, scales, path);
  };
}

}  // namespace rheocyte
