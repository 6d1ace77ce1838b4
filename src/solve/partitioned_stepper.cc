#include "solve/partitioned_stepper.h"

#include <algorithm>
#include <cmath>

#include "fem/end_loads.h"
#include "fem/moving_system.h"
#include "fem/observe.h"
#include "solve/rigid_start.h"

namespace rheocyte {
namespace {

/// Fraction of the present pressure drop that the controller leaves alone.
constexpr double controller_inertia = 0.9;

constexpr double folded = 1e-3;  ///< least volume of an element, in that at rest, that a shape may have

/// Whether the cell still has a shape: finite, and no element turned inside out.
bool is_sound(const Discretisation& space, const VectorXd& unknowns) {
  if (!unknowns.allFinite()) return false;
  for (int e = 0; e < int(space.elements().size()); ++e) {
    auto undeformed = space.elements()[e].undeformed.begin();
    for (const auto& fields : fields_at_points<MapFields<double, 2>>(space, e, unknowns))
      if (!(PointMap<double, 2>(fields).det > folded * (undeformed++)->det)) return false;
  }
  return true;
}

}  // namespace

PartitionedStepper::PartitionedStepper(const Problem& problem, const Resolution& resolution,
                                       const PartitionedOptions& options)
    : Stepper(problem, resolution), options_(options), discrete_(problem_, resolution), system_(space()) {}

Status PartitionedStepper::start() {
  MovingSystem rigid(space());
  NewtonOptions options = {1e-9};
  options.residual_scale = residual_scale(rigid, media_);
  TimeLevel level;
  const Status status = flow_round_sphere(rigid, media_, options, level.unknowns);
  if (status != Status::converged) return status;
  level.velocities = rigid.node_velocities(level.unknowns);
  const double v_cell = level.unknowns(space().cell_velocity());
  for (int node = 0; node < space().nodes().count; ++node) level.velocities(2 * node) += v_cell;
  state_ = {};
  state_.resolution = resolution_;
  state_.levels = {level};
  state_.next_step = options_.step;
  return Status::converged;
}

TimeStepReport PartitionedStepper::step(double limit) {
  TimeStepReport report;
  const double room = limit - now().time, size = std::min(options_.step, room);
  report.step = size > room * (1 - 1e-9) ? room : size;
  report.order = 1;
  SplitState split{now().unknowns, now().velocities, state_.traction, state_.inlet_pressure};
  VectorXd load;
  report.status = Status::singular_matrix;
  if (!system_.step_liquid(media_, report.step, split, load)) return report;
  // The sphere that starts feels the whole traction of its liquid.
  split.traction = split.traction.size() == 0
                       ? load
                       : VectorXd((1 - options_.relaxation) * split.traction + options_.relaxation * load);
  if (!system_.step_cell(media_, report.step, split)) return report;
  system_.move(report.step, split);
  report.status = is_sound(space(), split.unknowns) ? Status::converged : Status::mesh_folded;
  if (report.status != Status::converged) return report;
  const int v = space().cell_velocity();
  TimeLevel level{now().time + report.step, split.unknowns, split.velocities, 0};
  level.position = now().position + report.step * split.unknowns(v);
  level.frame_acceleration = (split.unknowns(v) - now().unknowns(v)) / report.step;
  state_.levels = {level, now()};
  state_.traction = split.traction;
  if (problem_.drive == Drive::controlled_pressure) state_.inlet_pressure = controlled_pressure(split.unknowns);
  return report;
}

double PartitionedStepper::controlled_pressure(const VectorXd& unknowns) const {
  const double at_ends = undisturbed_inlet_pressure(space(), media_.liquid), drop = 2 * at_ends + state_.inlet_pressure;
  const double rate = flow_rate(space(), unknowns);
  return drop / (controller_inertia + (1 - controller_inertia) * rate) - 2 * at_ends;
}

TimeLevel PartitionedStepper::level_at(double time) const {
  if (state_.levels.size() < 2) return now();
  const TimeLevel& before = state_.levels[1];
  const double fraction = (time - before.time) / (now().time - before.time);
  TimeLevel level;
  level.time = time;
  level.unknowns = fraction * now().unknowns + (1 - fraction) * before.unknowns;
  level.position = fraction * now().position + (1 - fraction) * before.position;
  level.frame_acceleration = now().frame_acceleration;  // that of the step
  return level;
}

double PartitionedStepper::next_position(double time) const {
  return now().position + (time - now().time) * now().unknowns(space().cell_velocity());
}

WorkMeter PartitionedStepper::work() const {
  WorkMeter work;
  work.factorisations = system_.factorisations();
  return work;
}

}  // namespace rheocyte
