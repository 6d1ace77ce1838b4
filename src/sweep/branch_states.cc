#include "sweep/branch_states.h"

#include <cmath>
#include <limits>

#include "numeric/hermite.h"
#include "shape/measures.h"

namespace rheocyte {
namespace {

/// Ever finer resolutions; a state is accurate if the one before gives the same deformation. Its error is taken as this
/// fraction of the change from the level before.
struct Level {
  Resolution resolution;
  double fraction_of_change;
};
const std::array<Level, 6> resolutions = {{{{{2, 4, 1, 2}, 5}, 1},
                                           {{{2, 4, 1, 2}, 6}, 1},
                                           {{{2, 4, 1, 2}, 8}, 0.5},
                                           {{{3, 6, 1, 2}, 8}, 0.5},
                                           {{{3, 6, 1, 2}, 10}, 0.5},
                                           {{{4, 8, 2, 2}, 10}, 0.5}}};
/// Of the admitted error; a state that is less accurate is solved on the next level, if it is there.
constexpr double wanted_fraction = 0.5;
/// Of Newton's method; on the level before, whose state only tells the error, less will do.
constexpr double tolerance = 1e-10, tolerance_before = 1e-8;
/// Steps in u of states that the coarser mesh has and the finer one does not are halved down to this.
constexpr double least_advance = 1e-3;
/// Displacement of the first state, in r0; its deformation is some 1e-5.
constexpr double first_displacement = 0.006;
/// Step in u for slopes of the measures along the tangent.
constexpr double slope_step = 1e-4;

double factorisation_seconds_of(TubeDiscrete& discrete) { return discrete.system().work().factorisation_s; }

}  // namespace

BranchStates::BranchStates(const TableSpec& spec, const SweepPoint& place, const std::atomic<bool>* stop)
    : spec_(spec), place_(place), axial_ratio_(place.axial_ratio) {
  static_assert(resolutions.size() == levels);
  place_.axial_ratio = 0;
  newton_.stop = stop;
  newton_.tolerance = tolerance;
}

double BranchStates::log_progress(const BranchNode& node) const { return std::log(node.at(progress_of(spec_))); }
double BranchStates::log_progress_slope(const BranchNode& node) const {
  return node.slope(int(progress_of(spec_))) / node.at(progress_of(spec_));
}

double BranchStates::power() const { return progress_of(spec_) == Measure::mode_3 ? 1 : 2; }

double BranchStates::admitted_error(const BranchNode& node) const {
  return spec_.accuracy * std::max(1.0, std::abs(log_progress_slope(node)) / power());
}

double BranchStates::stiffness(double u) const { return first_stiffness_ * std::exp(-u); }
Problem BranchStates::problem(double u) const { return problem_of(case_at(spec_, place_, stiffness(u))); }

TubeDiscrete& BranchStates::at_level(int level) {
  if (!discrete_[level])
    discrete_[level] = std::make_unique<TubeDiscrete>(problem(0), resolutions[std::size_t(level)].resolution);
  return *discrete_[level];
}

Path BranchStates::path(int level, double end) {
  return {[this, level](double) -> NonlinearSystem& { return at_level(level).system(); },
          [this](double u) { return media_at(problem(u), 1); }, end, -std::numeric_limits<double>::infinity()};
}

ContinuationOptions BranchStates::continuation() {
  ContinuationOptions options;
  options.newton = newton_;
  options.newton.iteration_limit = 5;
  options.accept = [this](const NonlinearSystem& system, const BranchState& state) {
    const bool accepted = !is_wrinkled(problem(state.parameter), space_of(system), state.unknowns);
    refused_ += !accepted;
    return accepted;
  };
  return options;
}

namespace {

BranchNode unmeasured(double u, int level, VectorXd unknowns) {
  BranchNode node;
  node.u = u;
  node.level = level;
  node.unknowns = std::move(unknowns);
  return node;
}

}  // namespace

BranchStates::Way BranchStates::enter() {
  Way way = enter_round();
  return way.status == Status::converged && axial_ratio_ != 0 ? draw_out(way.last) : way;
}

BranchStates::Way BranchStates::enter_round() {
  TubeDiscrete& discrete = at_level(0);
  ContinuationOptions start = continuation();
  start.accept = {};
  start.displacement_per_step = first_displacement;
  for (int attempt = 0; attempt < 30; ++attempt) {
    const ContinuationReport report = start_branch(stiffness_path(discrete.system(), problem(0)), start);
    count(report.newton_iterations);
    if (report.status != Status::converged) return {report.status, {}};
    const double d = shape(0, report.last.unknowns).deformation;
    if (report.last.parameter == 1 && d <= spec_.min_deformation)
      return {Status::converged, unmeasured(0, 0, report.last.unknowns)};
    // The deformation goes with the square of the compliance.
    first_stiffness_ *=
        report.last.parameter < 1 ? 1.01 / report.last.parameter : 1.05 * std::sqrt(d / spec_.min_deformation);
  }
  return {Status::iteration_limit, {}};
}

BranchStates::Way BranchStates::draw_out(const BranchNode& round) {
  const auto problem_at = [this](double fraction) {
    SweepPoint place = place_;
    place.axial_ratio = fraction * axial_ratio_;
    return problem_of(case_at(spec_, place, first_stiffness_));
  };
  Path drawing =
      stiffness_path(at_level(0).system(), [&](double fraction) { return media_at(problem_at(fraction), 1); });
  drawing.origin = -std::numeric_limits<double>::infinity();
  ContinuationOptions options = continuation();
  options.accept = [&](const NonlinearSystem& system, const BranchState& state) {
    return !is_wrinkled(problem_at(state.parameter), space_of(system), state.unknowns);
  };
  const ContinuationReport report = continue_branch(drawing, options, {0, round.unknowns, {}, 0});
  count(report.newton_iterations);
  place_.axial_ratio = axial_ratio_;
  return {report.status, unmeasured(0, 0, report.last.unknowns)};
}

BranchStates::Way BranchStates::walk(const BranchNode& from, double u) {
  const ContinuationReport report =
      continue_branch(path(from.level, u), continuation(), {from.u, from.unknowns, from.tangent, 0});
  count(report.newton_iterations);
  return {report.status, unmeasured(report.last.parameter, from.level, report.last.unknowns)};
}

BranchStates::Way BranchStates::advance(const BranchNode& from, double u) {
  const int coarse = from.level - 1;
  BranchNode start = unmeasured(from.u, coarse, carried(from.unknowns, from.level, coarse));
  start.tangent = carried(from.tangent, from.level, coarse);
  Way way = walk(start, u);
  const double reached = way.last.u;
  if (reached == from.u) {
    // Near a fold the coarser branch may end before the finer one.
    const bool is_final = way.status == Status::stopped || way.status == Status::surface_unstable;
    return is_final ? Way{way.status, from} : walk(from, u);
  }
  if (refine(way.last)) return way;
  if (newton_.stop && *newton_.stop) return {Status::stopped, from};
  // Near its end the finer branch may have ended before.
  const double nearer = (from.u + reached) / 2;
  return nearer - from.u > least_advance ? advance(from, nearer) : Way{Status::surface_unstable, from};
}

VectorXd BranchStates::carried(const VectorXd& unknowns, int from, int to) {
  if (from == to || unknowns.size() == 0) return unknowns;
  return transfer(at_level(from).space(), unknowns, at_level(to).space());
}

BranchStates::Way BranchStates::between(const BranchNode& a, const BranchNode& b, double u) {
  TubeDiscrete& discrete = at_level(b.level);
  VectorXd found = cubic_between(a, b, std::expm1(u - a.u) / std::expm1(b.u - a.u));
  const NewtonReport report = newton(discrete.system(), media_at(problem(u), 1), newton_, found);
  count(report.iterations);
  Status status = report.status;
  if (status == Status::converged && is_wrinkled(problem(u), discrete.space(), found))
    status = Status::surface_unstable;
  return {status, unmeasured(u, b.level, std::move(found))};
}

bool BranchStates::measure(BranchNode& node) {
  const Scales scales = scales_of(case_at(spec_, place_, first_stiffness_));
  while (true) {
    TubeDiscrete& discrete = at_level(node.level);
    const Problem here = problem(node.u);
    discrete.system().linearise(media_at(here, 1), node.unknowns);
    if (!discrete.system().has_factors()) return false;
    node.tangent = branch_tangent(path(node.level, node.u), {node.u, node.unknowns, {}, 0});
    measure_with_slopes(node, scales);
    node.error = error_of(node);
    const double admitted = admitted_error(node);
    if (node.error <= wanted_fraction * admitted) return true;
    if (refine(node)) continue;
    refused_ += node.error > admitted;
    return node.error <= admitted;
  }
}

void BranchStates::measure_with_slopes(BranchNode& node, const Scales& scales) {
  const auto moved = [&](double step) {
    return measure_state(at_level(node.level).space(), problem(node.u + step), scales,
                         node.unknowns + step * node.tangent);
  };
  const MeasuredState plus = moved(slope_step), minus = moved(-slope_step);
  node.state = moved(0);
  node.slope = (plus.value - minus.value) / (2 * slope_step);
  node.contour_slope = (plus.contour - minus.contour) / (2 * slope_step);
}

double BranchStates::error_of(const BranchNode& node) {
  const auto error_from = [&](double before) {
    return resolutions[std::size_t(node.level)].fraction_of_change * std::abs(before / node.at(progress_of(spec_)) - 1);
  };
  if (node.progress_before > 0) return error_from(node.progress_before);
  TubeDiscrete& before = at_level(node.level - 1);
  VectorXd unknowns = transfer(at_level(node.level).space(), node.unknowns, before.space());
  NewtonOptions options = newton_;
  options.tolerance = tolerance_before;
  const NewtonReport report = newton(before.system(), media_at(problem(node.u), 1), options, unknowns);
  count(report.iterations);
  if (report.status != Status::converged) return std::numeric_limits<double>::infinity();
  return error_from(progress(node.level - 1, unknowns));
}

bool BranchStates::refine(BranchNode& node) {
  if (node.level + 1 >= levels) return false;
  TubeDiscrete& next = at_level(node.level + 1);
  VectorXd unknowns = transfer(at_level(node.level).space(), node.unknowns, next.space());
  const NewtonReport report = newton(next.system(), media_at(problem(node.u), 1), newton_, unknowns);
  count(report.iterations);
  if (report.status != Status::converged || is_wrinkled(problem(node.u), next.space(), unknowns)) return false;
  node.progress_before = progress(node.level, node.unknowns);
  // A measured state keeps its tangent, which cubics from it to others need; carried over, it is good enough for them.
  node.tangent = carried(node.tangent, node.level, node.level + 1);
  ++node.level;
  node.unknowns = unknowns;
  return true;
}

VectorXd BranchStates::cubic_between(const BranchNode& a, const BranchNode& b, double part) {
  const double way = std::expm1(b.u - a.u);  // in the compliance, over that of a
  const VectorXd slope = way * carried(a.tangent, a.level, b.level), end_slope = way * std::exp(a.u - b.u) * b.tangent;
  return hermite(part)(carried(a.unknowns, a.level, b.level), b.unknowns, slope, end_slope);
}

double BranchStates::log_progress_between(const BranchNode& a, const BranchNode& b, double part) {
  return std::log(progress(b.level, cubic_between(a, b, part)));
}

ShapeMeasures BranchStates::shape(int level, const VectorXd& unknowns) {
  return rheocyte::measure(contour(at_level(level).space(), unknowns));
}

double BranchStates::progress(int level, const VectorXd& unknowns) {
  StateNumbers numbers;
  numbers.shape = shape(level, unknowns);
  return table_measures[std::size_t(int(progress_of(spec_)))].value(numbers);
}

void BranchStates::count(int iterations) {
  ++solves_;
  newton_iterations_ += iterations;
}

void BranchStates::release_coarser_than(int level) {
  for (int i = 0; i < level - 1; ++i) {
    if (discrete_[i]) released_factorisation_ += factorisation_seconds_of(*discrete_[i]);
    discrete_[i].reset();
  }
}

double BranchStates::factorisation_seconds() const {
  double seconds = released_factorisation_;
  for (const auto& discrete : discrete_)
    if (discrete) seconds += factorisation_seconds_of(*discrete);
  return seconds;
}

}  // namespace rheocyte
