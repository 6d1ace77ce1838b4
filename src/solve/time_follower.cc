#include "solve/time_follower.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "solve/duct.h"
#include "solve/partitioned_stepper.h"
#include "solve/time_resolution.h"
#include "solve/time_stepper.h"

namespace rheocyte {
namespace {

constexpr double residual_of_step = 1e-3, min_tolerance = 1e-9, max_tolerance = 1e-6;
/// Newton's method leaves errors of displacements, which over a shorter step would make more than a tenth of the mean
/// velocity.
constexpr double min_step_of_tolerance = 10;
constexpr double first_step_of_accuracy = 8, max_first_step = 0.01;

TimeStepOptions step_options(const Problem& problem, const TimeRun& run, const WorkLimits& limits) {
  TimeStepOptions options;
  options.accuracy = run.accuracy;
  options.newton.stop = limits.stop;
  options.threads = limits.threads;
  if (is_duct(problem.section)) {
    // A deformation changes by about as much as the residual, the surface by more than that in a step that is accurate.
    options.newton.tolerance = std::clamp(residual_of_step * run.accuracy, min_tolerance, max_tolerance);
    // A factorisation takes as long as so many chord steps, also from one step to the next.
    options.newton.chord_limit = 15;
    options.newton.keep_factors = true;
    // Without inertia nothing is fast at the start but the cell itself.
    options.first_step = std::clamp(first_step_of_accuracy * run.accuracy, options.first_step, max_first_step);
  }
  options.first_step *= run.step_factor;
  options.max_step *= run.step_factor;
  options.min_step = min_step_of_tolerance * options.newton.tolerance;
  return options;
}

std::unique_ptr<Stepper> make_stepper(const Problem& problem, const TimeRun& run, const Resolution& resolution,
                                      const WorkLimits& limits) {
  if (run.scheme == TimeScheme::partitioned)
    return std::make_unique<PartitionedStepper>(problem, resolution, PartitionedOptions{run.step});
  return std::make_unique<TimeStepper>(problem, resolution, step_options(problem, run, limits));
}

/// Whether a shape no longer changes: its rate falls as r(t) = r0 exp(-t / tau), or so, and what is left of its way,
/// r tau, is small against what it has gone (docs/theory-time.md, sec. "settling"). Seen by the last levels alone, so
/// that a run that was continued ends where it would have ended in one go.
bool shape_has_settled(const Stepper& stepper) {
  // Steps that become as short as this, in the time gone, end a run that finds no more states: they show no rate.
  constexpr double fraction_left = 1e-4, fraction_of_noise = 1e-6, fraction_of_time = 1e-4;
  constexpr int intervals = 4;
  if (stepper.problem().offset != 0) return false;  // it drifts as long as it is on its way
  const std::vector<TimeLevel>& levels = stepper.state().levels;
  if (levels.size() <= intervals || !stepper.has_passed_walls(levels[intervals])) return false;
  const double gone = stepper.system().largest_displacement(levels[0].unknowns);
  double rate_after = 0, middle_after = 0;
  for (int i = 0; i < intervals; ++i) {
    const double step = levels[i].time - levels[i + 1].time, middle = (levels[i].time + levels[i + 1].time) / 2;
    if (step < fraction_of_time * levels[0].time) return false;
    const double moved = stepper.system().largest_displacement(levels[i].unknowns - levels[i + 1].unknowns);
    const double rate = moved / step;
    const bool falls = i > 0 && rate > rate_after && rate_after > 0;
    const double left = falls ? rate * (middle_after - middle) / std::log(rate / rate_after) : HUGE_VAL;
    if (i > 0 && !(left < fraction_left * gone) && !(moved < fraction_of_noise * gone)) return false;
    rate_after = rate;
    middle_after = middle;
  }
  return true;
}

constexpr const char* start_failed =
    "The flow round the sphere at rest was not found: the case is far outside the range of the solver.";

}  // namespace

TimeFollower::TimeFollower(const Problem& problem, const TimeRun& run, const Resolution& resolution,
                           const TimeObserver& observer, const WorkLimits& limits)
    : run_(run),
      degree_(resolution.degree),
      observer_(observer),
      limits_(limits),
      stepper_(make_stepper(problem, run, resolution, limits)) {}

std::string TimeFollower::fraction() const {
  const bool by_place = std::isfinite(run_.end_position);
  double fraction = 0;
  if (!stepper_->state().levels.empty())
    fraction = by_place ? stepper_->now().place() / run_.end_position : stepper_->now().time / run_.end;
  return fmt::format("{:.4g} % of the {}", 100 * fraction, by_place ? "way" : "time");
}

StationaryState TimeFollower::follow(const TimeStart* from, std::vector<TimeProbe>* probes) {
  const auto start = std::chrono::steady_clock::now();
  probes_ = probes;
  StationaryState result;
  Outcome& outcome = result.outcome;
  outcome.status = from ? resume(*from) : stepper_->start();
  if (outcome.status != Status::converged) return outcome.message = start_failed, result;
  if (!from || from->units) {
    show_frame(stepper_->now());
    if (observer_.step) observer_.step(describe(TimeStepReport{}), stepper_->state());
  }
  advance(result);
  stepper_->move_walls(stepper_->now().time);  // a step that failed has moved them
  describe_level(stepper_->now(), result);
  outcome.reached = 1;
  outcome.message = explanation(outcome.status);
  result.statistics.degree = degree_;
  result.statistics.total_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

Status TimeFollower::resume(const TimeStart& from) {
  if (!from.units) {
    stepper_->resume(from.state);
    settled_ = is_settled();
    return Status::converged;
  }
  const Problem& problem = stepper_->problem();
  TimeState state =
      is_duct(problem.section)
          ? at_time_zero(static_cast<const DuctDiscrete&>(stepper_->discrete()).space(), 3, from.state, *from.units)
          : at_time_zero(stepper_->space(), 2, from.state, *from.units);
  state.next_step = step_options(problem, run_, limits_).first_step;
  return stepper_->resume(state), Status::converged;
}

bool TimeFollower::is_at_place() const {
  return stepper_->now().place() >= run_.end_position * (1 - 1e-9) - tolerance_of_place(stepper_->problem(), run_);
}

bool TimeFollower::is_arrived() const { return stepper_->now().time >= run_.end * (1 - 1e-12) || is_at_place(); }

bool TimeFollower::is_settled() const {
  return run_.ends_when_settled && run_.scheme == TimeScheme::monolithic && !is_arrived() &&
         shape_has_settled(*stepper_);
}

void TimeFollower::advance(StationaryState& result) {
  SolveStatistics& statistics = result.statistics;
  fill_probes();
  while (result.outcome.status == Status::converged && !at_end()) {
    if (limits_.is_stopped()) {
      result.outcome.status = Status::stopped;
      break;
    }
    const double before = progress(stepper_->now());
    const double arrival = std::isfinite(run_.end_position) ? stepper_->time_at(run_.end_position) : HUGE_VAL;
    const TimeStepReport report = stepper_->step(std::min(run_.end, arrival));
    result.outcome.status = report.status;
    statistics.newton_iterations += report.newton_iterations;
    if (report.status != Status::converged) break;
    ++statistics.continuation_steps;
    result.residual = report.residual;
    settled_ = is_settled();
    show_frames(before);
    fill_probes();
    if (observer_.step) observer_.step(describe(report), stepper_->state());
  }
  statistics += stepper_->work();
}

TimePoint TimeFollower::describe(const TimeStepReport& report) const {
  const TimeLevel& now = stepper_->now();
  return {now.time, report.step, report.order, report.newton_iterations, report.refused, now.place(), numbers_of(now)};
}

void TimeFollower::describe_level(const TimeLevel& level, StationaryState& state) const {
  stepper_->discrete().describe(problem_now(), level.unknowns, state);
  add_inertia(level, state);
}

StateNumbers TimeFollower::numbers_of(const TimeLevel& level) const {
  StateNumbers numbers = stepper_->discrete().numbers(problem_now(), level.unknowns);
  add_inertia(level, numbers);
  return numbers;
}

void TimeFollower::add_inertia(const TimeLevel& level, StateNumbers& numbers) const {
  // In the accelerated frame the solver's pressure contains that of the inertial force (eq:frame-pressure); the
  // splitting scheme solves in the laboratory.
  const double inertia = run_.scheme == TimeScheme::monolithic ? stepper_->media().liquid.reynolds : 0;
  numbers.pressure_drop += inertia * level.frame_acceleration * numbers.channel_length;
}

void TimeFollower::show_frame(const TimeLevel& level) const {
  if (!observer_.frame) return;
  StationaryState state;
  describe_level(level, state);
  observer_.frame({level.time, level.place(), std::move(state)});
}

void TimeFollower::show_frames(double before) const {
  if (!observer_.frame) return;
  const double now = progress(stepper_->now());
  const double gone = (before - run_.first_output) / run_.output_every;
  const double tolerance = run_.outputs_by_place ? tolerance_of_place(stepper_->problem(), run_) : 0;
  const long next = run_.first_output > 0 && gone < 0 ? 0 : std::lround(std::floor(gone * (1 + 1e-12))) + 1;
  for (long i = next;; ++i) {
    const double output = run_.first_output + double(i) * run_.output_every;
    if (output > now * (1 + 1e-12) || (at_end() && output > now * (1 - 1e-9) - tolerance)) break;
    const double time = run_.outputs_by_place ? stepper_->time_at(std::min(output, now)) : output;
    stepper_->move_walls(time);
    show_frame(stepper_->level_at(time));
  }
  stepper_->move_walls(stepper_->now().time);
  if (at_end()) show_frame(stepper_->now());
}

void TimeFollower::fill(TimeProbe& probe) const {
  const TimeLevel& now = stepper_->now();
  const double here = probe.by_place ? now.place() : now.time;
  for (std::size_t i = probe.seen.size(); i < probe.at.size() && (probe.at[i] <= here || at_end()); ++i) {
    const bool is_before = probe.at[i] < here;
    const double time = !is_before ? now.time : probe.by_place ? stepper_->time_at(probe.at[i]) : probe.at[i];
    stepper_->move_walls(time);
    const TimeLevel level = is_before ? stepper_->level_at(time) : now;
    probe.seen.push_back({.time = level.time, .position = level.place(), .state = numbers_of(level)});
  }
  stepper_->move_walls(now.time);
}

void TimeFollower::fill_probes() const {
  if (!probes_) return;
  for (TimeProbe& probe : *probes_) fill(probe);
}

std::string TimeFollower::explanation(Status status) const {
  if (status == Status::converged)
    return fmt::format("The cell was followed {} on a mesh of degree {}.",
                       settled_ ? "until it had settled" : "to the end", degree_);
  const TimeLevel& now = stepper_->now();
  if (status == Status::stopped)
    return fmt::format("Stopped by a signal at {}; --continue goes on from there.", fraction());
  const char* why =
      run_.scheme == TimeScheme::partitioned
          ? "the step is too large for elasticity that is explicit, lower time.step_us, or the cell elongates without "
            "limit or wrinkles"
          : "the cell elongates without limit or wrinkles, raise its moduli or lower flow rate or viscosity";
  const bool can_be_finer = !stepper_->has_passed_walls(now) && degree_ < max_time_degree_of(stepper_->problem());
  const std::string coarse =
      can_be_finer ? fmt::format(", or the wall is too steep for the mesh, try time.degree = {}", degree_ + 1) : "";
  return fmt::format("No step in time succeeds beyond {} ({}): {}{}; the last good state is kept.", fraction(),
                     name(status), why, coarse);
}

}  // namespace rheocyte
