#include "solve/time_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "solve/ladder.h"
#include "solve/local_errors.h"
#include "solve/time_follower.h"
#include "solve/time_resolution.h"

namespace rheocyte {
namespace {

/// What the changes to a coarser mesh count for beside those to a finer one, as in a duct (eq:square-error).
constexpr double fraction_of_change_before = 0.1;
/// Steps this much less accurate are compared with: their error is several times that of the run. Where no accuracy
/// limits the steps, at first and at the longest ones, they are longer, too.
constexpr double coarser_steps = 10, longer_steps = 2;
/// Beyond this accuracy steps are compared with finer ones: coarser ones would no longer follow the cell.
constexpr double max_coarser_accuracy = 1e-2;
/// Outlines of two runs may agree by chance: what each may be off at least, in the accuracy of each step.
constexpr double fraction_of_accuracy = 0.2;

/// The same run with other steps, or on another mesh.
struct OtherRun {
  double accuracy = 0;
  bool has_finer_steps = false;
  int degree = 0;
  Status status = Status::not_started;
  std::string fraction;  ///< of the way
  TimeWay way = {};      ///< at the steps and outputs of the first run
  /// At its steps by time or place, as the outputs are read.
  std::vector<TimePoint> levels = {};
  StateNumbers end = {};

  bool has_arrived() const { return status == Status::converged; }
  double deformation() const { return end.shape.deformation; }
};

TimeProbe probe_at(const std::vector<TimePoint>& points, bool by_place) {
  TimeProbe probe{by_place, {}};
  for (const TimePoint& point : points) probe.at.push_back(by_place ? point.position : point.time);
  return probe;
}

OtherRun follow_again(const FollowedRun& first, double accuracy, const Resolution& resolution,
                      const WorkLimits& limits) {
  TimeRun run = first.run;
  run.accuracy = accuracy;
  run.step_factor = accuracy > first.run.accuracy ? longer_steps : 1 / longer_steps;
  run.ends_when_settled = false;
  run.end = first.is_at_place ? HUGE_VAL : first.way.steps.back().time;
  if (!first.is_at_place) run.end_position = HUGE_VAL;
  std::vector<TimeProbe> probes{probe_at(first.way.steps, first.is_at_place),
                                probe_at(first.way.outputs, run.outputs_by_place)};
  const bool reads_steps_twice = first.is_at_place != run.outputs_by_place;
  if (reads_steps_twice) probes.push_back(probe_at(first.way.steps, run.outputs_by_place));
  TimeFollower follower(first.problem, run, resolution, {}, limits);
  const StationaryState end = follower.follow(nullptr, &probes);
  return {accuracy,
          accuracy < first.run.accuracy,
          resolution.degree,
          end.outcome.status,
          follower.fraction(),
          {probes[0].seen, probes[1].seen},
          reads_steps_twice ? probes[2].seen : probes[0].seen,
          end};
}

/// The runs that one is compared with, as far as there are any.
struct OtherRuns {
  double accuracy = 0;  ///< of the steps of the run itself
  OtherRun steps, coarse, fine;

  double min_outline() const { return fraction_of_accuracy * accuracy; }
  /// What a change to these steps counts for: finer ones are not yet right.
  double factor_of_steps() const { return steps.has_finer_steps ? 2 : 1; }
  bool tell() const { return steps.has_arrived() && (coarse.has_arrived() || fine.has_arrived()); }
  bool are_stopped() const {
    return std::ranges::any_of(std::array{steps.status, coarse.status, fine.status},
                               [](Status status) { return status == Status::stopped; });
  }
  /// The last one that was needed and did not arrive.
  const OtherRun& failed() const {
    if (!steps.has_arrived()) return steps;
    return fine.status == Status::not_started ? coarse : fine;
  }
};

/// The two parts of the errors of a state's numbers.
struct ErrorParts {
  StateNumbers steps, mesh;

  StateNumbers sum() const {
    StateNumbers errors = steps;
    add_errors(1, mesh, errors);
    return errors;
  }
};

/// The cell is incompressible: what its volume is off by is known. At the end of a step this is next to nothing, but
/// not between steps, where two runs may agree.
void know_of_volume(const StateNumbers& numbers, StateNumbers& errors) {
  const double change = numbers.relative_volume_change;
  errors.relative_volume_change = std::max(errors.relative_volume_change, std::abs(change));
  errors.shape.volume = std::max(errors.shape.volume, std::abs(change) / (1 + change) * numbers.shape.volume);
}

/// The same numbers of the runs, at a step, an output or the end (docs/theory-time.md, eq:error-in-time).
struct Compared {
  const StateNumbers &first, &steps, *coarse, *fine;
  double factor = 1;       ///< of the change to other steps
  double min_outline = 0;  ///< of the outline by the steps

  StateNumbers error_of_steps() const {
    StateNumbers errors = errors_of_change(steps, first, min_outline);
    add_errors(factor - 1, errors, errors);
    know_of_volume(first, errors);
    return errors;
  }
  StateNumbers error_of_mesh() const {
    if (!fine) return errors_of_change(*coarse, steps);
    std::vector<StateNumbers> ladder{steps, *fine};
    if (coarse) ladder.insert(ladder.begin(), *coarse);
    std::vector<double> deformations;
    for (const StateNumbers& rung : ladder) deformations.push_back(rung.shape.deformation);
    const double left = estimate_error(deformations, {.fraction_of_change_before = fraction_of_change_before});
    StateNumbers errors = distance(steps, *fine);
    add_errors(1, errors_of_last(ladder, left), errors);
    return errors;
  }
  ErrorParts error() const { return {error_of_steps(), error_of_mesh()}; }
};

/// By the numbers of the runs at the same points of the way, or in the last state.
Compared compared(const StateNumbers& first, const OtherRuns& others, const auto& numbers) {
  const auto of = [&](const OtherRun& run) { return run.has_arrived() ? &numbers(run) : nullptr; };
  return {first,           numbers(others.steps),    of(others.coarse),
          of(others.fine), others.factor_of_steps(), others.min_outline()};
}

std::vector<ErrorParts> error_parts(const std::vector<TimePoint>& points, const OtherRuns& others,
                                    const auto& points_of) {
  std::vector<ErrorParts> errors;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto here = [&](const OtherRun& run) -> const StateNumbers& { return points_of(run)[i].state; };
    errors.push_back(compared(points[i].state, others, here).error());
  }
  return errors;
}

/// The first run's errors at its levels, the ends of its steps. A state is one of a polynomial through order + 1 levels
/// (docs/theory-time.md, eq:error-of-levels): what they are off by makes its error. The change to another run, whose
/// steps are others, passes zero in one of them by chance, but not in all; where its steps are no longer than those of
/// the first run, it gives nothing, but the steps of the first run themselves do (eq:local-error).
class LevelErrors {
 public:
  LevelErrors(const std::vector<TimePoint>& levels, std::vector<ErrorParts> changes)
      : levels_(levels), changes_(std::move(changes)), local_(local_errors(levels)) {}

  /// Of a state at a time, for which those of its own change are given, in place of them.
  ErrorParts around(double time, ErrorParts own) const {
    const std::size_t end = level_after(time), before = std::min<std::size_t>(end, levels_[end].order);
    for (std::size_t i = end - before; i <= end; ++i) {
      take_greater(changes_[i].steps, own.steps);
      take_greater(changes_[i].mesh, own.mesh);
    }
    for (std::size_t i = end - before; i <= end; ++i) add_where_not_exact(local_.numbers[i], own.steps);
    return own;
  }
  /// Of the place at a time, by the steps until then.
  double position_error(double time) const { return local_.positions[level_after(time)]; }
  /// Of the time at which the cell is where it is then.
  double time_error(double time) const {
    return position_error(time) / std::abs(levels_[level_after(time)].state.cell_velocity);
  }

 private:
  std::size_t level_after(double time) const {
    const auto level = std::ranges::lower_bound(levels_, time, {}, &TimePoint::time);
    return std::min(std::size_t(level - levels_.begin()), levels_.size() - 1);
  }
  /// What is given has no error.
  static void add_where_not_exact(const StateNumbers& local, StateNumbers& errors) {
    for (const StateMeasure& measure : state_measures)
      if (measure.value(errors) != 0) measure.of(errors) += measure.value(local);
  }

  const std::vector<TimePoint>& levels_;
  std::vector<ErrorParts> changes_;
  LocalErrors local_;
};

/// Of times and positions no error becomes smaller on the way; a place at a time is no better than a step.
std::vector<TimePoint> errors_at(const std::vector<TimePoint>& points, const OtherRuns& others,
                                 std::vector<TimePoint> TimeWay::*which, bool by_place, const LevelErrors& levels) {
  const OtherRun& other = others.fine.has_arrived() ? others.fine : others.coarse;
  const std::vector<ErrorParts> parts = error_parts(
      points, others, [&](const OtherRun& run) -> const auto& { return run.way.*which; });
  std::vector<TimePoint> errors;
  double time = by_place ? others.accuracy : 0, position = by_place ? 0 : others.accuracy;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const TimePoint &steps = (others.steps.way.*which)[i], &mesh = (other.way.*which)[i];
    const auto error_of = [&](double TimePoint::*number) {
      return others.factor_of_steps() * std::abs(points[i].*number - steps.*number) +
             std::abs(steps.*number - mesh.*number);
    };
    const double here = points[i].time;
    time = std::max(time, error_of(&TimePoint::time) + (by_place ? levels.time_error(here) : 0));
    position = std::max(position, error_of(&TimePoint::position) + (by_place ? 0 : levels.position_error(here)));
    errors.push_back({.time = time, .position = position, .state = levels.around(here, parts[i]).sum()});
  }
  return errors;
}

std::string told(const OtherRun& mesh, const OtherRuns& others, double deformation) {
  std::string text = fmt::format(" A mesh of degree {} changes its last deformation by {:.2g} %", mesh.degree,
                                 100 * std::abs(mesh.deformation() - others.steps.deformation()) / deformation);
  double greatest = 0, change = 0;
  for (std::size_t i = 0; i < mesh.way.outputs.size(); ++i) {
    const double here = others.steps.way.outputs[i].state.shape.deformation;
    greatest = std::max(greatest, here);
    change = std::max(change, std::abs(here - mesh.way.outputs[i].state.shape.deformation));
  }
  if (greatest > 0) text += fmt::format(", and none by more than {:.2g} % of the maximum", 100 * change / greatest);
  return text + fmt::format(". Steps with time.accuracy = {:.2g} change it by {:.2g} %.", others.steps.accuracy,
                            100 * std::abs(others.steps.deformation() - deformation) / deformation);
}

std::string told_of_failure(const OtherRun& other, bool has_settled) {
  return fmt::format(" {} not known: the run to compare with, {}on a mesh of degree {}, ended at {} ({}).",
                     has_settled ? "The errors on the way are" : "How far it is off is",
                     other.accuracy > 0 ? fmt::format("with time.accuracy = {:.2g} ", other.accuracy) : "",
                     other.degree, other.fraction, name(other.status));
}

/// Coarser steps, or finer ones where those are too coarse or do not arrive.
OtherRun with_other_steps(const FollowedRun& first, const WorkLimits& limits) {
  const double coarser = coarser_steps * first.run.accuracy, finer = first.run.accuracy / coarser_steps;
  OtherRun steps = follow_again(first, coarser <= max_coarser_accuracy ? coarser : finer, first.resolution, limits);
  if (steps.accuracy == finer || steps.has_arrived() || steps.status == Status::stopped) return steps;
  return follow_again(first, finer, first.resolution, limits);
}

/// A coarser mesh gives an error that is at least that of the run; where this is not enough for what is requested, a
/// finer one gives more.
OtherRuns follow_others(const FollowedRun& first, const WorkLimits& limits, const StationaryState& result) {
  OtherRuns others{first.run.accuracy, with_other_steps(first, limits), {}, {}};
  if (!others.steps.has_arrived()) return others;
  const double accuracy = others.steps.accuracy;
  others.coarse = follow_again(first, accuracy, to_compare_with(first.problem, first.resolution), limits);
  if (others.coarse.status == Status::stopped) return others;
  const bool is_known = others.coarse.has_arrived();
  const double change = std::abs(others.coarse.deformation() - others.steps.deformation()) /
                        std::max(result.shape.deformation, result.deformation_floor);
  const Resolution finer{first.resolution.subdivision, first.resolution.degree + 1};
  const bool suffices = is_mesh_given(first.run) || (first.has_settled && is_known) ||
                        (is_known && (change <= first.run.mesh_accuracy || result.stability_margin < 0));
  const bool is_finest = finer.degree == others.coarse.degree || finer.degree > max_time_degree_of(first.problem);
  if (!suffices && !is_finest) others.fine = follow_again(first, accuracy, finer, limits);
  return others;
}

}  // namespace

TimeWay estimate_errors(const FollowedRun& first, const WorkLimits& limits, StationaryState& result) {
  const OtherRuns others = follow_others(first, limits, result);
  const double size = std::max(result.shape.deformation, result.deformation_floor);
  result.comparison = others.tell() ? Status::converged : others.failed().status;
  if (others.are_stopped()) {
    result.comparison = Status::stopped;
    result.outcome.status = Status::error_unknown;
    result.outcome.message += " A signal stopped the computation of its error; --continue computes it.";
    return {};
  }
  if (!others.tell()) {
    result.outcome.message += told_of_failure(others.failed(), first.has_settled);
    return {};
  }
  const OtherRun& mesh = others.fine.has_arrived() ? others.fine : others.coarse;
  const auto at_steps = [](const OtherRun& run) -> const auto& { return run.way.steps; };
  const auto at_levels = [](const OtherRun& run) -> const auto& { return run.levels; };
  const auto at_end = [](const OtherRun& run) -> const StateNumbers& { return run.end; };
  const std::vector<TimePoint>& steps = first.way.steps;
  const LevelErrors of_steps{steps, error_parts(steps, others, at_steps)};
  const LevelErrors of_outputs{steps, error_parts(steps, others, at_levels)};
  const ErrorParts end = of_steps.around(steps.back().time, compared(result, others, at_end).error());
  result.step_error = end.steps.shape.deformation / size;
  result.errors = end.sum();
  result.estimated_error = result.errors.shape.deformation / size;
  result.outcome.message += told(mesh, others, result.shape.deformation);
  return {errors_at(steps, others, &TimeWay::steps, first.is_at_place, of_steps),
          errors_at(first.way.outputs, others, &TimeWay::outputs, first.run.outputs_by_place, of_outputs)};
}

}  // namespace rheocyte
