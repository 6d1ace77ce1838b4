#include "solve/time_stepper.h"

#include <algorithm>
#include <cmath>

#include "solve/rigid_start.h"

namespace rheocyte {
namespace {

std::vector<double> times(const TimeState& state) {
  std::vector<double> result;
  for (const TimeLevel& level : state.levels) result.push_back(level.time);
  return result;
}

}  // namespace

/// A solved step that is not yet accepted.
struct TimeStepper::Trial {
  NewtonReport newton;
  BdfFormula formula;
  TimeLevel level;
  double error = 0;  ///< relative to the requested accuracy
};

TimeStepper::TimeStepper(const Problem& problem, const Resolution& resolution, const TimeStepOptions& options)
    : TimeStepper(problem, moving_discrete(with_elastic_interior(problem), resolution), options) {}

TimeStepper::TimeStepper(const Problem& problem, std::unique_ptr<MovingDiscrete> moving, const TimeStepOptions& options)
    : Stepper(problem, moving->discrete().resolution()),
      options_(options),
      moving_(std::move(moving)),
      surface_(moving_->surface_unknowns()) {
  moving_->system().obey({nullptr, options.threads});  // Newton's method stops between iterations
  options_.newton.residual_scale = residual_scale(moving_->system(), media_);
  // A viscosity in series with a spring does not damp short waves, least of all those of a cell that is let go.
  if (media_.bulk.branch_modulus > 0)
    options_.max_order =
        std::min(options_.max_order, problem_.start_stretch == 1 ? max_nearly_a_stable_order : max_a_stable_order);
  if (!problem_.wall.is_straight()) wall_.emplace(problem_.wall);
}

Status TimeStepper::start() {
  TimeLevel level;
  level.aside = moving_->first_aside();
  if (moves_mesh()) {
    const VectorXd sphere = 0 * moving_->system().sphere();
    level.outward = meet_walls(level, sphere);
    moving_->set_motion({0, sphere, 0 * moving_->node_velocities(sphere), 0 * level.outward});
  }
  NewtonOptions options = options_.newton;
  options.keep_factors = false;
  const Status status = flow_round_sphere(moving_->system(), media_, options, level.unknowns);
  if (status != Status::converged) return status;
  moving_->system().drop_factors();  // those of a rigid cell
  const double stretch = problem_.start_stretch * problem_.bulk.rest_stretch;
  if (stretch != 1) moving_->stretch_sphere(stretch, level.unknowns);
  level.barycentre = moving_->barycentre(level.unknowns);
  level.position -= level.barycentre;
  level.velocities = moving_->node_velocities(level.unknowns);
  if (media_.bulk.branch_modulus > 0) level.branch = moving_->unstressed_branch();
  state_ = {};
  state_.resolution = resolution_;
  state_.levels = {level};
  state_.next_step = options_.fixed_step > 0 ? options_.fixed_step : options_.first_step;
  return Status::converged;
}

VectorXd TimeStepper::extrapolate(int levels, double time, VectorXd TimeLevel::*field) const {
  const std::vector<double> past = times(state_);
  return combine(extrapolation_weights(std::span<const double>(past).first(levels), time), field);
}

VectorXd TimeStepper::combine(const VectorXd& weights, VectorXd TimeLevel::*field) const {
  VectorXd result = weights(0) * (state_.levels[0].*field);
  for (int i = 1; i < weights.size(); ++i) result += weights(i) * (state_.levels[i].*field);
  return result;
}

double TimeStepper::combine(const VectorXd& weights, double TimeLevel::*field) const {
  double result = 0;
  for (int i = 0; i < weights.size(); ++i) result += weights(i) * (state_.levels[i].*field);
  return result;
}

VectorXd TimeStepper::meet_walls(const TimeLevel& level, const VectorXd& unknowns) {
  const auto wall = [&](double x) { return wall_ ? wall_->radius(level.position + x) : 1; };
  VectorXd outward = moving_->wall_motion(wall, unknowns);
  moving_->move_nodes(outward, level.aside);
  return outward;
}

void TimeStepper::move_walls(double time) {
  if (!moves_mesh()) return;
  const VectorXd weights = weights_at(time);
  moving_->move_nodes(combine(weights, &TimeLevel::outward), combine(weights, &TimeLevel::aside));
}

VectorXd TimeStepper::weights_at(double time) const {
  const std::vector<double> past = times(state_);
  const int levels = std::min<int>(state_.order + 1, int(past.size()));
  return extrapolation_weights(std::span<const double>(past).first(levels), time);
}

TimeLevel TimeStepper::level_at(double time) const {
  const VectorXd weights = weights_at(time);
  TimeLevel level;
  level.time = time;
  level.unknowns = combine(weights, &TimeLevel::unknowns);
  level.position = combine(weights, &TimeLevel::position);
  level.barycentre = combine(weights, &TimeLevel::barycentre);
  level.aside = combine(weights, &TimeLevel::aside);
  level.frame_acceleration = combine(weights, &TimeLevel::frame_acceleration);
  return level;
}

double TimeStepper::place_after(const BdfFormula& formula, double velocity, double TimeLevel::*place) const {
  return (velocity - combine(formula.weights, place)) / formula.rate;
}

double TimeStepper::next_position(double time) const {
  if (!(time > now().time)) return now().place();
  const VectorXd weights = weights_at(time);
  double velocity = 0;
  for (int i = 0; i < weights.size(); ++i) velocity += weights(i) * state_.levels[i].unknowns(moving_->cell_velocity());
  return place_after(bdf_formula(times(state_), state_.order, time), velocity, &TimeLevel::position) +
         combine(weights, &TimeLevel::barycentre);
}

double TimeStepper::surface_change(const VectorXd& difference, double rate) const {
  double greatest = moving_->drift() < 0 ? 0 : std::abs(difference(moving_->drift())) / rate;
  for (const int unknown : surface_) greatest = std::max(greatest, std::abs(difference(unknown)));
  return greatest / problem_.radius_ratio / options_.accuracy;
}

void TimeStepper::renew_factors() {
  const KeptTangent& tangent = state_.tangent;
  if (system().has_factors() || tangent.unknowns.size() == 0) return;
  if (moves_mesh()) moving_->move_nodes(tangent.outward, tangent.aside);
  moving_->set_motion(tangent.motion);
  axial_tension(media_) = tangent.axial_tension;
  moving_->system().linearise(media_, tangent.unknowns);
}

NewtonReport TimeStepper::solve(const Motion& motion, TimeLevel& level) {
  moving_->set_motion(motion);
  NewtonOptions options = options_.newton;
  options.keep_factors = options.keep_factors && system().has_factors();
  NewtonReport report = newton(moving_->system(), media_, options, level.unknowns);
  if (!options_.newton.keep_factors) return report;
  if (!system().has_factors()) {
    state_.tangent = {};
  } else if (report.factored_at.size() > 0) {
    state_.tangent = {motion, axial_tension(media_), level.aside, level.outward, report.factored_at};
  }
  return report;
}

TimeStepper::Trial TimeStepper::attempt(double step, int order) {
  renew_factors();
  Trial trial;
  const std::vector<double> past = times(state_);
  trial.level.time = past[0] + step;
  trial.formula = bdf_formula(past, order, trial.level.time);
  const int v = moving_->cell_velocity(), levels = std::min<int>(order + 1, int(past.size()));
  const VectorXd guess = extrapolate(levels, trial.level.time), weights = trial.formula.weights.head(order);
  Motion motion{trial.formula.rate, combine(weights, &TimeLevel::unknowns), combine(weights, &TimeLevel::velocities)};
  trial.level.position = place_after(trial.formula, guess(v), &TimeLevel::position);
  if (const int drift = moving_->drift(); drift >= 0)
    trial.level.aside = place_after(trial.formula, guess(drift), &TimeLevel::aside), motion.turning = guess;
  if (moves_mesh()) {
    trial.level.outward = meet_walls(trial.level, guess);
    motion.outward = motion.rate * trial.level.outward + combine(weights, &TimeLevel::outward);
  }
  if (const AxialTensionTable& profile = problem_.tension_profile; !profile.is_even())
    axial_tension(media_) = profile.at(trial.level.position + now().barycentre);
  motion.branch = combine(weights, &TimeLevel::branch);
  if (motion.turning.size() > 0) motion.turning_branch = extrapolate(levels, trial.level.time, &TimeLevel::branch);
  trial.level.unknowns = guess;
  trial.newton = solve(motion, trial.level);
  if (trial.newton.status != Status::converged) return trial;
  trial.level.barycentre = moving_->barycentre(trial.level.unknowns);
  trial.level.velocities = moving_->node_velocities(trial.level.unknowns);
  if (media_.bulk.branch_modulus > 0) trial.level.branch = moving_->branch_metric(media_.bulk, trial.level.unknowns);
  trial.level.frame_acceleration = motion.rate * trial.level.unknowns(v) + motion.unknowns(v);
  const double fraction = levels > order ? trial.formula.error_fraction : error_fraction_of_first_step;
  trial.error = fraction * surface_change(trial.level.unknowns - guess, trial.formula.rate);
  return trial;
}

StepErrors TimeStepper::errors(const Trial& trial, int order) const {
  StepErrors result{-1, trial.error, -1};
  const std::vector<double> past = times(state_);
  const auto error_at = [&](int other) {
    const double fraction = bdf_formula(past, other, trial.level.time).error_fraction;
    return fraction *
           surface_change(trial.level.unknowns - extrapolate(other + 1, trial.level.time), trial.formula.rate);
  };
  if (order > 1) result.below = error_at(order - 1);
  const bool settled = state_.steps_at_order > order && order < options_.max_order;
  if (settled && int(past.size()) >= order + 2) result.above = error_at(order + 1);
  return result;
}

void TimeStepper::accept(const Trial& trial, int order) {
  const double step = trial.level.time - now().time;
  if (options_.fixed_step > 0) {
    state_.order = std::min<int>(order + 1, options_.max_order);
  } else {
    const StepChoice choice = choose_step(order, errors(trial, order));
    state_.steps_at_order = choice.order == order ? state_.steps_at_order + 1 : 0;
    state_.order = choice.order;
    // Where nothing comes any more that a long step would miss, steps have no limit.
    const double greatest = has_passed_walls(trial.level) ? HUGE_VAL : options_.max_step;
    state_.next_step = std::min(choice.factor * step, greatest);
  }
  state_.levels.insert(state_.levels.begin(), trial.level);
  if (int(state_.levels.size()) > options_.max_order + 2) state_.levels.pop_back();
}

TimeStepReport TimeStepper::step(double limit) {
  TimeStepReport report;
  double size = state_.next_step;
  int order = state_.order;
  const auto refuse = [&](double factor) {
    size *= factor;
    ++report.refused;
    if (report.refused > 2) order = 1;
  };
  for (;;) {
    const double room = limit - now().time;
    const bool last = size > room * (1 - 1e-9);
    const double wanted = size;
    const Trial trial = attempt(last ? room : size, order);
    report.newton_iterations += trial.newton.iterations;
    report.status = trial.newton.status;
    report.residual = trial.newton.residual;
    if (report.status == Status::stopped) return report;
    const bool controlled = options_.fixed_step == 0;
    if (report.status != Status::converged) {
      if (!controlled) return report;
      if (last) size = room;
      refuse(0.25);
    } else if (controlled && !(trial.error <= 1)) {
      if (last) size = room;
      refuse(shortening(order, trial.error));
    } else {
      report.step = trial.level.time - now().time;
      report.order = order;
      accept(trial, order);
      if (last) state_.next_step = std::max(state_.next_step, wanted);
      return report;
    }
    if (size < options_.min_step) {
      if (report.status == Status::converged) report.status = Status::accuracy_not_reached;
      return report;
    }
  }
}

}  // namespace rheocyte
