#include "solve/follow_in_time.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "fem/observe.h"
#include "solve/describe.h"
#include "solve/partitioned_stepper.h"
#include "solve/time_stepper.h"

namespace rheocyte {
namespace {

/// Resolves the stationary states of the paper's cells to 1e-5 of the deformation at degree 6
/// (docs/verification.md, sec. 9).
constexpr Subdivision subdivision = {2, 4, 1, 2};

/// So many elements along the surface, and as large ones as fit to them elsewhere.
Subdivision fine_subdivision(int surface_elements) {
  const int front = (surface_elements + 3) / 4;
  return {front, 2 * front, std::max(1, front / 8), 4};
}

TimeStepOptions step_options(const Problem& problem, const TimeRun& run, const std::atomic<bool>* stop) {
  TimeStepOptions options;
  options.accuracy = run.accuracy;
  options.newton.stop = stop;
  if (problem.wall.is_straight()) options.greatest_step = HUGE_VAL;  // nothing comes that a long step would miss
  return options;
}

std::unique_ptr<Stepper> make_stepper(const Problem& problem, const TimeRun& run, const std::atomic<bool>* stop) {
  const Resolution resolution{subdivision, run.degree};
  if (run.scheme == TimeScheme::partitioned) {
    const Resolution fine{fine_subdivision(run.surface_elements), run.degree};
    return std::make_unique<PartitionedStepper>(problem, run.surface_elements > 0 ? fine : resolution,
                                                PartitionedOptions{run.step});
  }
  return std::make_unique<TimeStepper>(problem, resolution, step_options(problem, run, stop));
}

/// Whether a shape no longer changes: its rate falls as r(t) = r0 exp(-t / tau), or so, and what is left of its way,
/// r tau, is small against what it has gone (docs/theory-time.md, sec. "settling"). Seen by the last levels alone, so
/// that a run that was continued ends where it would have ended in one go.
bool has_settled(const Discretisation& space, const std::vector<TimeLevel>& levels) {
  constexpr double share_left = 1e-4, share_of_noise = 1e-6;
  constexpr int intervals = 4;
  if (levels.size() <= intervals) return false;
  const double gone = largest_displacement(space, levels[0].unknowns);
  double rate_after = 0, middle_after = 0;
  for (int i = 0; i < intervals; ++i) {
    const double step = levels[i].time - levels[i + 1].time, middle = (levels[i].time + levels[i + 1].time) / 2;
    const double moved = largest_displacement(space, levels[i].unknowns - levels[i + 1].unknowns);
    const double rate = moved / step;
    const bool falls = i > 0 && rate > rate_after && rate_after > 0;
    const double left = falls ? rate * (middle_after - middle) / std::log(rate / rate_after) : HUGE_VAL;
    if (i > 0 && !(left < share_left * gone) && !(moved < share_of_noise * gone)) return false;
    rate_after = rate;
    middle_after = middle;
  }
  return true;
}

class TimeFollower {
 public:
  TimeFollower(const Problem& problem, const TimeRun& run, const TimeObserver& observer, const std::atomic<bool>* stop)
      : run_(run), observer_(observer), stop_(stop), stepper_(make_stepper(problem, run, stop)) {}

  StationaryState follow(const TimeStart* from) {
    const auto start = std::chrono::steady_clock::now();
    StationaryState result;
    Outcome& outcome = result.outcome;
    outcome.status = from ? resume(*from) : stepper_->start();
    if (outcome.status != Status::converged) return outcome.message = start_failed, result;
    if (!from || from->units) {
      show_frame(0, stepper_->now().unknowns);
      if (observer_.step) observer_.step(describe(TimeStepReport{}), stepper_->state());
    }
    advance(result);
    stepper_->move_walls(stepper_->now().time);  // a step that failed has moved them
    describe_state(stepper_->problem(), state_of(stepper_->now().unknowns), result);
    result.pressure_drop = describe(TimeStepReport{}).state.pressure_drop;
    outcome.reached = 1;
    outcome.message = explanation(outcome.status);
    result.statistics.degree = run_.degree;
    result.statistics.total_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
  }

 private:
  static constexpr const char* start_failed =
      "The flow round the sphere at rest was not found: the case is far outside what the solver can follow.";

  Status resume(const TimeStart& from) {
    if (!from.units) return stepper_->resume(from.state), Status::converged;
    TimeState state = at_time_zero(stepper_->space(), from.state, *from.units);
    state.next_step = TimeStepOptions{}.first_step;
    return stepper_->resume(state), Status::converged;
  }

  bool at_end() const { return settled_ || stepper_->now().time >= run_.end * (1 - 1e-12); }

  void advance(StationaryState& result) {
    SolveStatistics& statistics = result.statistics;
    while (result.outcome.status == Status::converged && !at_end()) {
      if (stop_ && *stop_) {
        result.outcome.status = Status::stopped;
        break;
      }
      const double before = stepper_->now().time;
      const TimeStepReport report = stepper_->step(run_.end);
      result.outcome.status = report.status;
      statistics.newton_iterations += report.newton_iterations;
      if (report.status != Status::converged) break;
      ++statistics.continuation_steps;
      result.residual = report.residual;
      settled_ = may_settle() && has_settled(stepper_->space(), stepper_->state().levels);
      show_frames(before);
      if (observer_.step) observer_.step(describe(report), stepper_->state());
    }
    const WorkMeter work = stepper_->work();
    statistics.factorisations = work.factorisations;
    statistics.assembly_s = work.assembly_s;
    statistics.factorisation_s = work.condensation_s + work.sparse_s;
    statistics.substitution_s = work.solve_s;
  }

  /// Where nothing changes any more but the cell.
  bool may_settle() const {
    return run_.scheme == TimeScheme::monolithic && stepper_->problem().wall.is_straight() &&
           stepper_->now().time < run_.end * (1 - 1e-12);
  }

  DiscreteState state_of(const VectorXd& unknowns) const { return {stepper_->discrete(), stepper_->media(), unknowns}; }

  TimePoint describe(const TimeStepReport& report) const {
    StationaryState state;
    const TimeLevel& now = stepper_->now();
    describe_state(stepper_->problem(), state_of(now.unknowns), state);
    // In the accelerated frame the solver's pressure contains that of the inertial force (eq:frame-pressure); the
    // splitting scheme solves in the laboratory.
    const double inertia = run_.scheme == TimeScheme::monolithic ? stepper_->media().liquid.reynolds : 0;
    state.pressure_drop += inertia * now.frame_acceleration * state.channel_length;
    return {now.time, report.step, report.order, report.newton_iterations, report.refused, now.position, state};
  }

  void show_frame(double time, const VectorXd& unknowns) const {
    if (!observer_.frame) return;
    StationaryState state;
    describe_state(stepper_->problem(), state_of(unknowns), state);
    observer_.frame({time, state.contour, state.write_fields});
  }

  /// Those between the last step and the one before.
  void show_frames(double before) const {
    const double now = stepper_->now().time;
    for (long i = std::lround(std::floor(before / run_.output_every * (1 + 1e-12))) + 1;; ++i) {
      const double time = i * run_.output_every;
      if (time > now * (1 + 1e-12) || time > run_.end * (1 - 1e-9)) break;
      stepper_->move_walls(time);
      show_frame(time, stepper_->unknowns_at(time));
    }
    stepper_->move_walls(now);
    if (at_end()) show_frame(settled_ ? now : run_.end, stepper_->now().unknowns);
  }

  std::string explanation(Status status) const {
    if (status == Status::converged)
      return fmt::format(
          "The cell was followed {} on one mesh of degree {}, whose error is not estimated: a run with another "
          "time.degree shows it.",
          settled_ ? "until it had settled" : "to the end", run_.degree);
    const double share = 100 * stepper_->now().time / run_.end;
    if (status == Status::stopped)
      return fmt::format("Stopped by a signal at {:.4g} % of the time; --continue goes on from there.", share);
    const char* why = run_.scheme == TimeScheme::partitioned
                          ? "the step is too large for elasticity that is explicit, lower time.step_us, or the cell is "
                            "drawn out or wrinkles"
                          : "the cell is drawn out or wrinkles, raise its moduli or lower flow rate or viscosity";
    return fmt::format("No step in time succeeds beyond {:.4g} % of the time ({}): {}; the last good state is kept.",
                       share, name(status), why);
  }

  TimeRun run_;
  TimeObserver observer_;
  const std::atomic<bool>* stop_;
  std::unique_ptr<Stepper> stepper_;
  bool settled_ = false;
};

}  // namespace

StationaryState follow_in_time(const Problem& problem, const TimeRun& run, const TimeObserver& observer,
                               const TimeStart* from, const std::atomic<bool>* stop) {
  return TimeFollower(problem, run, observer, stop).follow(from);
}

}  // namespace rheocyte
