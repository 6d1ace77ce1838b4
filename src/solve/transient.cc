#include "solve/transient.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "fem/observe.h"
#include "solve/duct.h"
#include "solve/ladder.h"
#include "solve/partitioned_stepper.h"
#include "solve/time_resolution.h"
#include "solve/time_stepper.h"

namespace rheocyte {
namespace {

/// So many elements along the surface, and as large ones as fit to them elsewhere.
Subdivision fine_subdivision(int surface_elements) {
  const int front = (surface_elements + 3) / 4;
  return {front, 2 * front, std::max(1, front / 8), 4};
}

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
  options.min_step = min_step_of_tolerance * options.newton.tolerance;
  return options;
}

/// Whether the user has chosen the mesh; then no accuracy is wanted of it.
bool is_mesh_given(const TimeRun& run) { return run.degree > 0 || run.scheme == TimeScheme::partitioned; }

Resolution resolution_of(const Problem& problem, const TimeRun& run, const WorkLimits& limits) {
  Resolution resolution = usual_time_resolution_of(problem);
  if (run.degree > 0) resolution.degree = run.degree;
  if (run.scheme == TimeScheme::partitioned && run.surface_elements > 0)
    resolution.subdivision = fine_subdivision(run.surface_elements);
  return is_mesh_given(run) ? resolution : resolution_in_time(problem, run.mesh_accuracy, limits);
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
bool has_settled(const Stepper& stepper) {
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

class TimeFollower {
 public:
  TimeFollower(const Problem& problem, const TimeRun& run, const Resolution& resolution, const TimeObserver& observer,
               const WorkLimits& limits)
      : run_(run),
        degree_(resolution.degree),
        observer_(observer),
        limits_(limits),
        stepper_(make_stepper(problem, run, resolution, limits)) {}

  bool has_settled() const { return settled_; }
  /// "12 % of the way": how far it has come.
  std::string fraction() const {
    const bool by_place = std::isfinite(run_.end_position);
    double fraction = 0;
    if (!stepper_->state().levels.empty())
      fraction = by_place ? stepper_->now().place() / run_.end_position : stepper_->now().time / run_.end;
    return fmt::format("{:.4g} % of the {}", 100 * fraction, by_place ? "way" : "time");
  }

  StationaryState follow(const TimeStart* from) {
    const auto start = std::chrono::steady_clock::now();
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

 private:
  static constexpr const char* start_failed =
      "The flow round the sphere at rest was not found: the case is far outside what the solver can follow.";

  Status resume(const TimeStart& from) {
    if (!from.units) return stepper_->resume(from.state), Status::converged;
    const Problem& problem = stepper_->problem();
    TimeState state =
        is_duct(problem.section)
            ? at_time_zero(static_cast<const DuctDiscrete&>(stepper_->discrete()).space(), 3, from.state, *from.units)
            : at_time_zero(stepper_->space(), 2, from.state, *from.units);
    state.next_step = step_options(problem, run_, limits_).first_step;
    return stepper_->resume(state), Status::converged;
  }

  bool is_arrived() const {
    const TimeLevel& now = stepper_->now();
    const double place = run_.end_position * (1 - 1e-9) - place_tolerance(stepper_->problem(), run_);
    return now.time >= run_.end * (1 - 1e-12) || now.place() >= place;
  }
  bool at_end() const { return settled_ || is_arrived(); }

  void advance(StationaryState& result) {
    SolveStatistics& statistics = result.statistics;
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
      settled_ = run_.scheme == TimeScheme::monolithic && !is_arrived() && rheocyte::has_settled(*stepper_);
      show_frames(before);
      if (observer_.step) observer_.step(describe(report), stepper_->state());
    }
    statistics += stepper_->work();
  }

  TimePoint describe(const TimeStepReport& report) const {
    const TimeLevel& now = stepper_->now();
    StateNumbers numbers = stepper_->discrete().numbers(problem_now(), now.unknowns);
    add_inertia(now, numbers);
    return {now.time, report.step, report.order, report.newton_iterations, report.refused, now.place(), numbers};
  }

  Problem problem_now() const { return with_media(stepper_->problem(), stepper_->media()); }

  /// The walls must be where they are at that time.
  void describe_level(const TimeLevel& level, StationaryState& state) const {
    stepper_->discrete().describe(problem_now(), level.unknowns, state);
    add_inertia(level, state);
  }

  void add_inertia(const TimeLevel& level, StateNumbers& numbers) const {
    // In the accelerated frame the solver's pressure contains that of the inertial force (eq:frame-pressure); the
    // splitting scheme solves in the laboratory.
    const double inertia = run_.scheme == TimeScheme::monolithic ? stepper_->media().liquid.reynolds : 0;
    numbers.pressure_drop += inertia * level.frame_acceleration * numbers.channel_length;
  }

  void show_frame(const TimeLevel& level) const {
    if (!observer_.frame) return;
    StationaryState state;
    describe_level(level, state);
    observer_.frame({level.time, level.place(), std::move(state)});
  }

  /// Time or place of a level, whichever the outputs follow.
  double progress(const TimeLevel& level) const { return run_.outputs_by_place ? level.place() : level.time; }

  /// Those between the last step and the one before.
  void show_frames(double before) const {
    const double now = progress(stepper_->now());
    const double gone = (before - run_.first_output) / run_.output_every;
    const double tolerance = run_.outputs_by_place ? place_tolerance(stepper_->problem(), run_) : 0;
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

  std::string explanation(Status status) const {
    if (status == Status::converged)
      return fmt::format("The cell was followed {} on a mesh of degree {}.",
                         settled_ ? "until it had settled" : "to the end", degree_);
    const TimeLevel& now = stepper_->now();
    if (status == Status::stopped)
      return fmt::format("Stopped by a signal at {}; --continue goes on from there.", fraction());
    const char* why = run_.scheme == TimeScheme::partitioned
                          ? "the step is too large for elasticity that is explicit, lower time.step_us, or the cell is "
                            "drawn out or wrinkles"
                          : "the cell is drawn out or wrinkles, raise its moduli or lower flow rate or viscosity";
    const bool can_be_finer = !stepper_->has_passed_walls(now) && degree_ < max_time_degree_of(stepper_->problem());
    const std::string coarse =
        can_be_finer ? fmt::format(", or the wall is too steep for the mesh, try time.degree = {}", degree_ + 1) : "";
    return fmt::format("No step in time succeeds beyond {} ({}): {}{}; the last good state is kept.", fraction(),
                       name(status), why, coarse);
  }

  TimeRun run_;
  int degree_;
  TimeObserver observer_;
  WorkLimits limits_;
  std::unique_ptr<Stepper> stepper_;
  bool settled_ = false;
};

/// What the changes to a coarser mesh count for beside those to a finer one, as in a duct (eq:square-error).
constexpr double fraction_of_change_before = 0.1;

using Deformations = std::vector<double>;  // output by output

TimeObserver noting(Deformations& deformations, TimeObserver observer) {
  observer.frame = [&deformations, show = observer.frame](const TimeFrame& frame) {
    deformations.push_back(frame.state.shape.deformation);
    if (show) show(frame);
  };
  return observer;
}

/// The same run on another mesh.
struct OtherRun {
  int degree = 0;
  Status status = Status::not_started;
  std::string fraction;  ///< of the way
  std::vector<TimePoint> steps = {};
  StateNumbers numbers = {};   ///< of the last state
  double greatest_change = 0;  ///< of a deformation at an output, over the greatest one; NaN without outputs
};

OtherRun run_on(const Resolution& resolution, const Problem& problem, const TimeRun& run,
                const Deformations& deformations, const WorkLimits& limits) {
  Deformations compared;
  std::vector<TimePoint> steps;
  const auto note_step = [&steps](const TimePoint& point, const TimeState&) { steps.push_back(point); };
  const TimeObserver observer = noting(compared, {.frame = {}, .step = note_step, .compared = {}});
  TimeFollower follower(problem, run, resolution, observer, limits);
  const StationaryState end = follower.follow(nullptr);
  // Of a run that went on from a checkpoint the last outputs are there alone.
  if (end.outcome.status == Status::converged && compared.size() > deformations.size())
    compared.erase(compared.begin(), compared.end() - std::ptrdiff_t(deformations.size()));
  double greatest = 0, change = 0;
  for (std::size_t i = 0; i < std::min(deformations.size(), compared.size()); ++i) {
    greatest = std::max(greatest, deformations[i]);
    change = std::max(change, std::abs(deformations[i] - compared[i]));
  }
  return {resolution.degree, end.outcome.status, follower.fraction(), std::move(steps), end, change / greatest};
}

std::string told(const OtherRun& other, double deformation) {
  const double change = std::abs(other.numbers.shape.deformation - deformation) / deformation;
  std::string text =
      fmt::format(" A mesh of degree {} changes its last deformation by {:.2g} %", other.degree, 100 * change);
  if (std::isfinite(other.greatest_change))
    text += fmt::format(", and none by more than {:.2g} % of the greatest", 100 * other.greatest_change);
  return text + ".";
}

std::string told_of_failure(const OtherRun& other) {
  return fmt::format(
      " How far it is off is not known: the run to compare with, on a mesh of degree {}, ended at {} ({}).",
      other.degree, other.fraction, name(other.status));
}

/// From a second run, on a mesh that is a degree coarser: the change is the error of that one, and that of the first
/// run is smaller. Where that is not enough for the wanted accuracy, from a third one, a degree finer. Gives the steps
/// of the run that tells the error; none if nothing does.
std::vector<TimePoint> estimate_error(const Problem& problem, const TimeRun& run, const Resolution& resolution,
                                      const Deformations& deformations, const WorkLimits& limits,
                                      StationaryState& result) {
  const double d = result.shape.deformation, size = std::max(d, result.deformation_floor);
  const OtherRun coarse = run_on(to_compare_with(problem, resolution), problem, run, deformations, limits);
  result.comparison = coarse.status;
  const bool is_known = coarse.status == Status::converged;
  const double change = std::abs(coarse.numbers.shape.deformation - d) / size;
  if (is_known) {
    result.estimated_error = change;
    result.errors = distance(result, coarse.numbers);
  }
  const Resolution finer{resolution.subdivision, resolution.degree + 1};
  const bool suffices =
      is_mesh_given(run) || (is_known && (change <= run.mesh_accuracy || result.stability_margin < 0));
  const bool is_finest = finer.degree == coarse.degree || finer.degree > max_time_degree_of(problem);
  if (suffices || is_finest || coarse.status == Status::stopped) {
    result.outcome.message += is_known ? told(coarse, d) : told_of_failure(coarse);
    return is_known ? coarse.steps : std::vector<TimePoint>();
  }
  const OtherRun fine = run_on(finer, problem, run, deformations, limits);
  const bool is_stopped = fine.status == Status::stopped;
  if (!is_known || is_stopped) result.comparison = fine.status;
  if (is_stopped) {
    result.estimated_error = no_value;
    result.errors = unknown_numbers();
  }
  if (fine.status != Status::converged) {
    const bool is_told = is_known && !is_stopped;
    result.outcome.message += is_told ? told(coarse, d) : told_of_failure(fine);
    return is_told ? coarse.steps : std::vector<TimePoint>();
  }
  std::vector<StateNumbers> ladder{result, fine.numbers};
  if (is_known) ladder.insert(ladder.begin(), coarse.numbers);
  std::vector<double> deformations_of_ladder;
  for (const StateNumbers& rung : ladder) deformations_of_ladder.push_back(rung.shape.deformation);
  const double d_fine = fine.numbers.shape.deformation, change_to_fine = std::abs(d_fine - d) / size,
               left = rheocyte::estimate_error(deformations_of_ladder,
                                               {.fraction_of_change_before = fraction_of_change_before});
  result.estimated_error = change_to_fine + left * d_fine / size;
  result.errors = distance(result, fine.numbers);
  add_errors(1, errors_of_last(ladder, left), result.errors);
  result.outcome.message += told(fine, d);
  return fine.steps;
}

}  // namespace

StationaryState transient(const Problem& problem, const TimeRun& run, const TimeObserver& observer,
                          const TimeStart* from, const WorkLimits& limits) {
  const Resolution resolution = from ? from->state.resolution : resolution_of(problem, run, limits);
  // What begins with the state of another case has no coarser counterpart.
  const bool estimates = run.estimates_error && !(from && from->units);
  Deformations deformations;
  TimeFollower follower(problem, run, resolution, estimates ? noting(deformations, observer) : observer, limits);
  StationaryState result = follower.follow(from);
  if (!is_mesh_given(run)) result.deformation_floor = run.accuracy / run.mesh_accuracy;
  if (estimates && result.outcome.status == Status::converged && !follower.has_settled()) {
    const auto compared = estimate_error(problem, run, resolution, deformations, limits, result);
    if (observer.compared && !compared.empty()) observer.compared(compared);
  }
  return result;
}

}  // namespace rheocyte
