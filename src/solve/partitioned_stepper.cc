#include "solve/partitioned_stepper.h"

#include "solve/rigid_start.h"

namespace rheocyte {

PartitionedStepper::PartitionedStepper(const Problem& problem, const Resolution& resolution,
                                       const PartitionedOptions& options)
    : options_(options),
      discrete_(std::make_shared<Discrete>(with_elastic_interior(problem), resolution)),
      system_(discrete_->space),
      media_(moving_media(with_elastic_interior(problem))) {}

Status PartitionedStepper::start() {
  MovingSystem rigid(space());
  NewtonOptions options = {1e-9};
  options.residual_scale = residual_scale(rigid, media_);
  const Status status = flow_round_sphere(rigid, media_, options, state_.unknowns);
  if (status != Status::converged) return status;
  const double v_cell = state_.unknowns(space().cell_velocity());
  state_.velocities = rigid.node_velocities(state_.unknowns);
  for (int node = 0; node < space().nodes().count; ++node) state_.velocities(2 * node) += v_cell;
  state_.traction.resize(0);
  time_ = 0;
  return Status::converged;
}

Status PartitionedStepper::step() {
  VectorXd load;
  if (!system_.step_liquid(media_, options_.step, state_, load)) return Status::singular_matrix;
  // The sphere that starts feels the whole traction of its liquid.
  const double share = state_.traction.size() == 0 ? 1 : options_.relaxation;
  if (share == 1) state_.traction = load;
  state_.traction = (1 - share) * state_.traction + share * load;
  if (!system_.step_cell(media_, options_.step, state_)) return Status::singular_matrix;
  system_.move(options_.step, state_);
  time_ += options_.step;
  return state_.unknowns.allFinite() ? Status::converged : Status::not_finite;
}

}  // namespace rheocyte
