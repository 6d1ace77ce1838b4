#include "result/judge_end.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "case/scales.h"
#include "result/result_in_time.h"
#include "solve/time_resolution.h"

namespace rheocyte {

namespace {

constexpr double fraction_of_time = 0.1, fraction_of_distance = 0.1;
/// Of the accuracy that is requested of the run, what the stationary shape that it is compared with may be off.
constexpr double fraction_of_stationary = 0.1;

TimeEnd end_of(const TimeRecord& record, const Result& result) {
  const Status status = result.state.outcome.status;
  if (status != Status::converged && status != Status::error_unknown) return TimeEnd::failure;
  const TimeCase& asked = result.input.time;
  const HistoryRow& last = record.rows.back();
  const double tolerance_um =
      result.scales.length_um() * tolerance_of_place(result.problem, time_run_of(result.input, result.scales));
  if (asked.end_um && last.position_um >= (1 - 1e-8) * *asked.end_um - tolerance_um) return TimeEnd::place;
  if (asked.end_us && last.t_us >= (1 - 1e-9) * *asked.end_us) return TimeEnd::time;
  return TimeEnd::settled;
}

std::string told(double deformation, double distance, bool settled) {
  const std::string text = fmt::format(" The stationary shape has the deformation {:.5f}; the run ended {:.2g} % {} it",
                                       deformation, 100 * std::abs(distance), distance < 0 ? "below" : "above");
  return text + (settled ? ": the cell has settled, and that is the error of the mesh." : ": it has not settled.");
}

/// Where the surface was compressed, and whether anything held it.
std::string told_of_surface(const TimeRecord& record, const Problem& problem) {
  constexpr double fraction_of_rounding = 1e-6;
  const HistoryRow& slack = min_tension(record);
  const HistoryRow& unstable =
      *std::ranges::min_element(record.rows, {}, [](const HistoryRow& row) { return row.measure("stability_margin"); });
  const double margin = unstable.measure("stability_margin"), tension = slack.measure("least_tension_mN_per_m");
  const auto when = [](const HistoryRow& row) {
    return fmt::format("at {:.4g} us, after {:.4g} um", row.t_us, row.position_um);
  };
  const bool bends = surface_kind(problem) == SurfaceKind::held;
  if (margin < 0) {
    const double here = unstable.measure("least_tension_mN_per_m");
    const bool collapses = bends || (surface_kind(problem) == SurfaceKind::membrane && here > 0);
    return fmt::format(
        " On the way the {}, which the model does not follow (stability_margin {:.2g}, smallest tension {:.3g} mN/m, "
        "{}).",
        collapses ? "cortex had lost its resistance to compression"
                  : "surface was beyond its limit against short wrinkles",
        margin, here, when(unstable));
  }
  const double greatest = std::ranges::max(record.rows, {}, [](const HistoryRow& row) {
                            return std::abs(row.measure("least_tension_mN_per_m"));
                          }).measure("least_tension_mN_per_m");
  if (tension >= -fraction_of_rounding * std::abs(greatest)) return "";
  return fmt::format(
      " On the way the surface was compressed (smallest tension {:.3g} mN/m, {}); {} it against wrinkles.", tension,
      when(slack), bends ? "its bending stiffness holds" : "the interior holds");
}

/// Of a duct, whose inertia is left out: its Reynolds number, which the state gets, by the greater of the densities.
std::string told_of_inertia(Result& result) {
  constexpr double considerable = 1;
  const double density = std::max(result.input.flow.density_kg_per_m3, result.input.cell.density_kg_per_m3.value_or(0));
  if (!is_duct(result.problem.section) || density == 0) return "";
  const double U = result.scales.velocity_m_per_s, unit = density * U * U / result.scales.stress_Pa;
  StationaryState& state = result.state;
  state.reynolds = unit * state.cell_velocity;
  state.errors.reynolds = unit * state.errors.cell_velocity;
  return fmt::format(" Inertia is left out (Reynolds number {:.2g}){}", state.reynolds,
                     state.reynolds < considerable
                         ? "."
                         : ": it is not small, and the stationary shape, without [time], has its inertia.");
}

/// The straight channel behind the cell's way, if all of the simulated one lies in it and the cell keeps a shape there.
std::optional<Problem> straight_from_here(const Result& result, const TimeRecord& record) {
  if (result.input.cell.viscoelasticity == Viscoelasticity::maxwell || result.problem.offset != 0) return {};
  if (result.problem.wall.is_straight()) return result.problem;
  const double half_um = result.scales.length_um() * result.state.channel_length / 2;
  const double changes_um = result.scales.length_um() * last_change(result.problem.wall);
  if (record.rows.back().position_um - half_um < changes_um) return {};
  Case straight = result.input;
  if (!straight.channel.profile.axial_tension_Pa.empty())
    straight.flow.axial_tension_Pa = straight.channel.profile.axial_tension_Pa.back();
  const ChannelProfile profile = std::exchange(straight.channel.profile, {});
  if (is_duct(straight.channel.section)) {
    straight.channel.section = Section::rectangle;
    straight.channel.height_um = straight.channel.height_um.value_or(least_width_um(result.input.channel));
    straight.channel.width_um = profile.width_um.back();
    if (straight.channel.width_um == straight.channel.height_um) straight.channel.section = Section::square;
  } else {
    straight.channel.radius_um = wall_um(profile).radius.back();
  }
  Problem problem = problem_of(straight);
  if (problem.radius_ratio < min_radius_ratio) return {};
  return problem;
}

/// What is left of the way of a cell whose deformation has settled: other numbers may still be on theirs. The changes
/// of two tenths of the time are those of a geometric series.
StateNumbers left_of_way(const TimeRecord& record) {
  const std::vector<TimePoint>& steps = record.way.steps;
  const auto state_before = [&](double fraction) {
    const auto after = std::ranges::upper_bound(steps, fraction * steps.back().time, {}, &TimePoint::time);
    return std::prev(after)->state;
  };
  const std::array states{state_before(1 - 2 * fraction_of_time), state_before(1 - fraction_of_time),
                          steps.back().state};
  std::array<double, states.size()> deformations{};
  std::ranges::transform(states, deformations.begin(), [](const StateNumbers& at) { return at.shape.deformation; });
  StateNumbers errors = errors_of_last(states, 0);
  errors.shape.deformation = error_of_last(deformations);
  return errors;
}

/// Errors of a settled state's numbers by those of the stationary one and by what is left of the way to it; where its
/// channel is another, only of those without a unit, and where the simulated piece has another length, not of the drop
/// along it: those stay.
StateNumbers errors_by(const StationaryState& stationary, const StateNumbers& left, bool is_other_channel,
                       const StationaryState& settled) {
  StateNumbers errors = distance(settled, stationary);
  add_errors(1, stationary.errors, errors);
  add_errors(1, left, errors);
  for (const StateMeasure& measure : state_measures)
    if (is_other_channel && unit_of(measure.name).dimension != no_unit.dimension)
      measure.of(errors) = measure.value(settled.errors);
  constexpr double of_rounding = 1e-9;
  if (std::abs(settled.channel_length - stationary.channel_length) > of_rounding * stationary.channel_length) {
    errors.channel_length = settled.errors.channel_length;
    errors.pressure_drop = settled.errors.pressure_drop;
  }
  return errors;
}

void compare_with_stationary(Result& result, TimeRecord& record, const Problem& problem, const WorkLimits& limits) {
  Outcome& outcome = result.state.outcome;
  const StationaryState stationary = solve_stationary(problem, {}, limits);
  const Status there = stationary.outcome.status;
  const bool failed = record.end == TimeEnd::failure;
  if (there == Status::stopped) {
    if (!failed && std::isnan(result.state.estimated_error)) outcome.status = Status::error_unknown;
    return;
  }
  if (!has_state(there)) {
    const bool seems_settled = !failed && (record.end == TimeEnd::settled || has_settled(record, 0, problem.accuracy));
    outcome.message += fmt::format(" There is no stationary shape of this cell ({}){}", name(there),
                                   failed          ? "."
                                   : seems_settled ? ": what seems to settle is stabilised by the mesh."
                                                   : ": it has not settled, and will not.");
    if (seems_settled) outcome.status = there;
    return;
  }
  if (failed) return;
  record.stationary_deformation = stationary.shape.deformation;
  record.stationary_error = stationary.errors.shape.deformation;
  const double distance = result.state.shape.deformation / stationary.shape.deformation - 1;
  const bool settled = record.end == TimeEnd::settled || has_settled(record, std::abs(distance), problem.accuracy);
  if (settled) {
    const bool is_other_channel =
        problem.radius_ratio != result.problem.radius_ratio || problem.extent.width != result.problem.extent.width;
    result.state.errors = errors_by(stationary, left_of_way(record), is_other_channel, result.state);
    result.state.estimated_error =
        result.state.errors.shape.deformation / std::max(stationary.shape.deformation, result.state.deformation_floor);
    result.state.step_error = 0;  // whatever they were, the shape is the stationary one
  }
  outcome.message += told(stationary.shape.deformation, distance, settled);
}

/// Whether the run to compare with failed and nothing else gives the error.
bool is_error_unknown(const StationaryState& state) {
  const bool has_failed = state.comparison != Status::not_started && state.comparison != Status::converged &&
                          state.comparison != Status::stopped;
  return has_failed && !std::isfinite(state.estimated_error);
}

/// What time.mesh_accuracy is of: the error without that of the steps.
double mesh_error(const StationaryState& state) {
  return std::isfinite(state.step_error) ? std::max(state.estimated_error - state.step_error, 0.0)
                                         : state.estimated_error;
}

/// A finer mesh as far as there is one; else to ask for less. With a greater accuracy the floor falls.
std::string ways_to_mesh_accuracy(const Problem& problem, const StationaryState& state) {
  const int finer = state.statistics.degree + 2;
  if (finer <= max_time_degree_of(problem))
    return fmt::format("take a finer mesh, time.degree = {} in place of time.mesh_accuracy.", finer);
  const double d = state.shape.deformation;
  return ways_to_accuracy("time.mesh_accuracy", mesh_error(state) * std::max(d, state.deformation_floor) / d);
}

/// Where the steps make the error greater than what the mesh may make.
std::string steps_text(const StationaryState& state, double wanted) {
  if (!(state.estimated_error > wanted) || !(state.step_error > state.estimated_error / 2)) return {};
  return fmt::format(
      " The error of its deformation is estimated at {:.1e}, {:.1e} of it by the steps: lower time.accuracy.",
      state.estimated_error, state.step_error);
}

/// Settles the status by the last state.
void judge(Result& result) {
  const StationaryState& state = result.state;
  const double wanted = result.input.time.mesh_accuracy.value_or(HUGE_VAL), error = mesh_error(state);
  const bool is_unknown = is_error_unknown(state);
  Outcome& outcome = result.state.outcome;
  outcome.message += steps_text(state, wanted);
  const Status status = judged(outcome.status, {state.stability_margin, is_unknown ? HUGE_VAL : error, wanted});
  if (status == outcome.status) return;
  outcome.status = status;
  if (status == Status::surface_unstable)
    outcome.message += " It is also so at the end; " + ways_to_stability(surface_kind(result.problem), true);
  else if (is_unknown)
    outcome.message +=
        fmt::format(" Whether it is within the requested {:.1e} (time.mesh_accuracy) is unknown.", wanted);
  else
    outcome.message += fmt::format(" The mesh makes an error of {:.1e}, and {:.1e} is requested; {}", error, wanted,
                                   ways_to_mesh_accuracy(result.problem, state));
}

}  // namespace

bool has_settled(const TimeRecord& record, double distance, double accuracy) {
  const double end = record.rows.back().t_us, d = record.rows.back().measure("deformation");
  double before = record.rows.front().measure("deformation");  // at the last step before the last tenth
  for (const HistoryRow& row : record.rows)
    if (row.t_us <= (1 - fraction_of_time) * end) before = row.measure("deformation");
  const double change = std::abs(d - before);
  return change < std::max(fraction_of_distance * distance, accuracy) * std::abs(d);
}

void judge_end(Result& result, TimeRecord& record, const WorkLimits& limits) {
  if (record.rows.empty()) return;
  record.end = end_of(record, result);
  record.comparison = result.state.comparison;
  if (result.state.outcome.status != Status::stopped)
    if (auto problem = straight_from_here(result, record)) {
      const double wanted = result.input.time.mesh_accuracy.value_or(HUGE_VAL);
      problem->accuracy = std::min(problem->accuracy, fraction_of_stationary * wanted);
      compare_with_stationary(result, record, *problem, limits);
    }
  result.state.outcome.message += told_of_surface(record, result.problem) + told_of_inertia(result);
  judge(result);
}

}  // namespace rheocyte
