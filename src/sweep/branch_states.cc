#include "sweep/branch_states.h"

#include <cmath>
#include <limits>

#include "numeric/hermite.h"
#include "shape/measures.h"
#include "solve/fit_on_the_way.h"
#include "solve/settle.h"

namespace rheocyte {
namespace {

/// Of the admitted error; a state that is less accurate is solved on the next level, if it is there.
constexpr double wanted_fraction = 0.5;
/// Of Newton's method; on the level before, whose state only gives the error, less will do.
constexpr double tolerance = 1e-10, tolerance_before = 1e-8;
/// Of bare surfaces, and of bent ones, whose meshes are fitted on the way: each try takes seconds there.
constexpr double least_advance_of_bare = 1e-3, least_advance_of_bent = 0.01;
/// Displacement of the first state, in r0; its deformation is some 1e-5.
constexpr double first_displacement = 0.006;
/// Step in u for slopes of the measures along the tangent.
constexpr double slope_step = 1e-4;

}  // namespace

BranchStates::BranchStates(const TableSpec& spec, const SweepPoint& place, const std::atomic<bool>* stop)
    : spec_(spec), place_(place), axial_ratio_(place.axial_ratio) {
  place_.axial_ratio = 0;
  newton_.stop = stop;
  newton_.tolerance = tolerance;
}

double BranchStates::log_progress(const BranchNode& node) const { return std::log(node.at(progress_of(spec_))); }
double BranchStates::log_progress_slope(const BranchNode& node) const {
  return node.slope(int(progress_of(spec_))) / node.at(progress_of(spec_));
}

double BranchStates::least_advance() const {
  return problem(0).cortex.bending > 0 ? least_advance_of_bent : least_advance_of_bare;
}

double BranchStates::power() const { return progress_of(spec_) == Measure::mode_3 ? 1 : 2; }

double BranchStates::admitted_error(const BranchNode& node) const {
  return spec_.accuracy * std::max(1.0, std::abs(log_progress_slope(node)) / power());
}

double BranchStates::stiffness(double u) const { return first_stiffness_ * std::exp(-u); }
Problem BranchStates::problem(double u) const { return problem_of(case_at(spec_, place_, stiffness(u))); }

Path BranchStates::path(TubeDiscrete& discrete, double end) const {
  return {[&discrete](double) -> NonlinearSystem& { return discrete.system(); },
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

BranchNode unmeasured(double u, BranchMeshes& meshes, int level, VectorXd unknowns) {
  BranchNode node;
  node.u = u;
  node.meshes = &meshes;
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
  BranchMeshes& meshes = *meshes_.emplace_back(std::make_unique<BranchMeshes>(problem(0)));
  TubeDiscrete& discrete = meshes.at(0);
  ContinuationOptions start = continuation();
  start.accept = {};
  start.displacement_per_step = first_displacement;
  for (int attempt = 0; attempt < 30; ++attempt) {
    const ContinuationReport report = start_branch(stiffness_path(discrete.system(), problem(0)), start);
    count(report.newton_iterations);
    if (report.status != Status::converged) return {report.status, {}};
    const double d = discrete.deformation(problem(0), report.last.unknowns);
    if (report.last.parameter == 1 && d <= spec_.min_deformation)
      return {Status::converged, unmeasured(0, meshes, 0, report.last.unknowns)};
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
      stiffness_path(discrete_of(round).system(), [&](double fraction) { return media_at(problem_at(fraction), 1); });
  drawing.origin = -std::numeric_limits<double>::infinity();
  ContinuationOptions options = continuation();
  options.accept = [&](const NonlinearSystem& system, const BranchState& state) {
    return !is_wrinkled(problem_at(state.parameter), space_of(system), state.unknowns);
  };
  const ContinuationReport report = continue_branch(drawing, options, {0, round.unknowns, {}, 0});
  count(report.newton_iterations);
  place_.axial_ratio = axial_ratio_;
  return {report.status, unmeasured(0, *round.meshes, 0, report.last.unknowns)};
}

BranchStates::Way BranchStates::walk(const BranchNode& from, double u) {
  Way way{Status::converged, unmeasured(from.u, *from.meshes, from.level, from.unknowns)};
  BranchState last{from.u, from.unknowns, from.tangent, 0};
  const auto go = [&](bool pauses) {
    TubeDiscrete& discrete = discrete_of(way.last);
    ContinuationOptions options = continuation();
    if (pauses) options.pause = [&](const BranchState& found) { return discrete.is_worn(found.unknowns); };
    const ContinuationReport report = continue_branch(path(discrete, u), options, last);
    count(report.newton_iterations);
    last = report.last;
    way.status = report.status;
    way.last.u = last.parameter;
    way.last.unknowns = last.unknowns;
    return WayPoint{way.status, way.last.u};
  };
  // Bare surfaces lose stability before they need it.
  if (problem(from.u).cortex.bending == 0) return go(false), way;
  fit_on_the_way(u, go, [&] {
    if (!fit(way.last)) return false;
    last.unknowns = way.last.unknowns;
    last.tangent = {};
    return true;
  });
  return way;
}

bool BranchStates::fit(BranchNode& node) {
  return discrete_of(node).try_fitted(node.unknowns, [&](const std::shared_ptr<Discrete>& fitted, VectorXd guess) {
    auto meshes = std::make_unique<BranchMeshes>(problem(0), fitted);
    if (solve(meshes->at(node.level), node.u, tolerance, guess) != Status::converged) return false;
    for (const auto& former : meshes_) former->drop_factors();
    node.meshes = meshes_.emplace_back(std::move(meshes)).get();
    node.unknowns = std::move(guess);
    return true;
  });
}

Status BranchStates::solve(TubeDiscrete& discrete, double u, double to_tolerance, VectorXd& unknowns) {
  const Problem here = problem(u);
  NewtonOptions options = newton_;
  options.tolerance = to_tolerance;
  VectorXd found = unknowns;
  const auto find = here.cortex.bending > 0 ? newton_or_settle : newton;
  const NewtonReport report = find(discrete.system(), media_at(here, 1), options, found);
  count(report.iterations);
  if (report.status == Status::converged) unknowns = std::move(found);
  return report.status;
}

BranchStates::Way BranchStates::advance(const BranchNode& from, double u) {
  const TubeDiscrete &fine = discrete_of(from), &coarse = from.meshes->at(from.level - 1);
  BranchNode start = unmeasured(from.u, *from.meshes, from.level - 1, coarse.transfer_from(fine, from.unknowns));
  if (from.tangent.size() > 0) start.tangent = coarse.transfer_from(fine, from.tangent);
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
  return nearer - from.u > least_advance() ? advance(from, nearer) : Way{Status::surface_unstable, from};
}

BranchStates::Way BranchStates::between(const BranchNode& a, const BranchNode& b, double u) {
  TubeDiscrete& discrete = discrete_of(b);
  VectorXd found = cubic_between(a, b, std::expm1(u - a.u) / std::expm1(b.u - a.u));
  Status status = solve(discrete, u, tolerance, found);
  if (status == Status::converged && discrete.is_wrinkled(problem(u), found)) status = Status::surface_unstable;
  return {status, unmeasured(u, *b.meshes, b.level, std::move(found))};
}

bool BranchStates::measure(BranchNode& node) {
  const Scales scales = scales_of(case_at(spec_, place_, first_stiffness_));
  while (true) {
    TubeDiscrete& discrete = discrete_of(node);
    const Problem here = problem(node.u);
    discrete.system().linearise(media_at(here, 1), node.unknowns);
    if (!discrete.system().has_factors()) return false;
    node.tangent = branch_tangent(path(discrete, node.u), {node.u, node.unknowns, {}, 0});
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
    return measure_state(discrete_of(node).space(), problem(node.u + step), scales,
                         node.unknowns + step * node.tangent);
  };
  const MeasuredState plus = moved(slope_step), minus = moved(-slope_step);
  node.state = moved(0);
  node.slope = (plus.value - minus.value) / (2 * slope_step);
  node.contour_slope = (plus.contour - minus.contour) / (2 * slope_step);
}

double BranchStates::error_of(const BranchNode& node) {
  const auto error_from = [&](double before) {
    return fraction_of_change(problem(node.u), node.level) * std::abs(before / node.at(progress_of(spec_)) - 1);
  };
  if (node.progress_before > 0) return error_from(node.progress_before);
  TubeDiscrete& before = node.meshes->at(node.level - 1);
  VectorXd unknowns = before.transfer_from(discrete_of(node), node.unknowns);
  if (solve(before, node.u, tolerance_before, unknowns) != Status::converged)
    return std::numeric_limits<double>::infinity();
  return error_from(progress(before, unknowns));
}

bool BranchStates::refine(BranchNode& node) {
  if (node.level + 1 >= BranchMeshes::levels) return false;
  TubeDiscrete &own = discrete_of(node), &next = node.meshes->at(node.level + 1);
  VectorXd unknowns = next.transfer_from(own, node.unknowns);
  if (solve(next, node.u, tolerance, unknowns) != Status::converged || next.is_wrinkled(problem(node.u), unknowns))
    return false;
  node.progress_before = progress(own, node.unknowns);
  // A measured state keeps its tangent, which cubics from it to others need; carried over, it is good enough for them.
  if (node.tangent.size() > 0) node.tangent = next.transfer_from(own, node.tangent);
  ++node.level;
  node.unknowns = unknowns;
  return true;
}

VectorXd BranchStates::cubic_between(const BranchNode& a, const BranchNode& b, double part) {
  const TubeDiscrete &of_a = discrete_of(a), &of_b = discrete_of(b);
  const auto carried = [&](const VectorXd& unknowns) {
    return &of_a == &of_b ? unknowns : of_b.transfer_from(of_a, unknowns);
  };
  const double way = std::expm1(b.u - a.u);  // in the compliance, over that of a
  const VectorXd slope = way * carried(a.tangent), end_slope = way * std::exp(a.u - b.u) * b.tangent;
  return hermite(part)(carried(a.unknowns), b.unknowns, slope, end_slope);
}

double BranchStates::log_progress_between(const BranchNode& a, const BranchNode& b, double part) {
  return std::log(progress(discrete_of(b), cubic_between(a, b, part)));
}

double BranchStates::progress(const TubeDiscrete& discrete, const VectorXd& unknowns) const {
  StateNumbers numbers;
  numbers.shape = rheocyte::measure(contour(discrete.space(), unknowns));
  return table_measures[std::size_t(int(progress_of(spec_)))].value(numbers);
}

void BranchStates::count(int iterations) {
  ++solves_;
  newton_iterations_ += iterations;
}

void BranchStates::release_coarser_than(const BranchNode& node) { node.meshes->release_coarser_than(node.level); }

double BranchStates::factorisation_seconds() const {
  double seconds = 0;
  for (const auto& meshes : meshes_) seconds += meshes->factorisation_seconds();
  return seconds;
}

}  // namespace rheocyte
