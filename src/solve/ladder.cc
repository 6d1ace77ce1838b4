#include "solve/ladder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "solve/describe.h"

namespace rheocyte {
namespace {

/// Finest degree on each mesh of the ladder, coarse to fine.
struct Rung {
  Subdivision subdivision;
  int first_degree, last_degree;
};
constexpr std::array<Rung, 3> meshes = {{{{2, 4, 1, 2}, 4, 9}, {{3, 6, 1, 2}, 7, 10}, {{4, 8, 2, 2}, 7, 10}}};
/// Only deformations below this are accepted for their small absolute error.
constexpr double tiny_deformation = 1e-5;
/// Less than the standard error that pixels leave of the mean deformation of a thousand events (0.005 each).
constexpr double seen_deformation = 1e-4;

/// No first change is trusted below this: neighbouring degrees may agree by chance.
constexpr double min_first_estimate = 2e-5;
/// Nor below this share of the change of the inertia ratio: two measures seldom agree by chance at once.
constexpr double share_of_inertia = 0.3;

/// Above this r0 / R the liquid's film is so thin and long that the coarsest mesh is only compared with.
constexpr double narrow_gap = 0.85;
bool has_narrow_gap(const Problem& problem) { return problem.radius_ratio > narrow_gap; }

/// Whether the surface is so near its limit that no mesh can hold the state.
bool is_nearly_unstable(const Problem& problem, const ResolvedState& state) {
  return state.branch.unknowns.size() > 0 &&
         stability_margin(problem, state.discrete->space, state.branch.unknowns) < small_margin;
}

}  // namespace

double estimate_error(const std::vector<double>& values, double share_of_change_before) {
  const std::size_t n = values.size();
  if (n < 2) return std::numeric_limits<double>::infinity();
  const double error = error_of_last(values, share_of_change_before) / std::max(std::abs(values[n - 1]), 1e-300);
  return n == 2 ? std::max(error, min_first_estimate) : error;
}

double deformation_floor(const Problem& problem) {
  if (problem.offset != 0) return seen_deformation;
  return std::min(deformation_round_off / problem.accuracy, tiny_deformation);
}

double stated_error(const Problem& problem, double relative_error, double deformation) {
  const double size = std::max(std::abs(deformation), 1e-300);
  return relative_error * size / std::max(size, deformation_floor(problem));
}

void Ladder::add(const Problem& problem, ResolvedState state) {
  numbers.push_back(numbers_of({problem, problem, state.discrete->space, state.branch.unknowns}));
  const ShapeMeasures& shape = numbers.back().shape;
  const double change = std::abs(shape.inertia_ratio - std::exchange(inertia_ratio, shape.inertia_ratio));
  deformations.push_back(shape.deformation);
  if (!keeps_systems && !rungs.empty()) rungs.back().discrete.reset();
  rungs.push_back(std::move(state));
  estimated_error = estimate_error(deformations);
  if (rungs.size() == 2)
    estimated_error = std::max(estimated_error, share_of_inertia * change / std::max(shape.deformation, 1e-300));
}

bool is_accurate(const Ladder& ladder, const Problem& problem) {
  if (ladder.rungs.size() < 2) return false;
  const bool coarsest = ladder.rungs.back().resolution.subdivision.top == meshes.front().subdivision.top;
  if (coarsest && has_narrow_gap(problem)) return false;
  return stated_error(problem, ladder.estimated_error, ladder.deformations.back()) <= problem.accuracy;
}

Status climb(const Problem& problem, const NewtonOptions& newton, ResolvedState state, Ladder& ladder,
             const RungObserver& observe) {
  Status reason = Status::accuracy_not_reached;
  for (const Rung& rung : meshes) {
    const auto elements = state.resolution.subdivision.top;
    if (rung.subdivision.top < elements) continue;
    const bool same_mesh = rung.subdivision.top == elements;
    const bool goes_on = (same_mesh || has_narrow_gap(problem)) && !ladder.rungs.empty();
    Ladder fresh{ladder.keeps_systems};  // a new mesh at a lower degree need not be better at once
    if (!goes_on) std::swap(ladder, fresh);
    int degree = rung.first_degree;
    if (same_mesh) degree = std::max(degree, state.resolution.degree + (goes_on ? 1 : 0));
    const bool only_begins = rung.subdivision.top == meshes.front().subdivision.top && has_narrow_gap(problem);
    const int last_degree = only_begins ? rung.first_degree + 1 : rung.last_degree;
    for (; degree <= last_degree; ++degree) {
      ResolvedState next = at_resolution(problem, newton, state, {rung.subdivision, degree});
      if (next.status == Status::stopped) {
        observe(next, nullptr);
        return Status::stopped;
      }
      if (next.status != Status::converged || is_wrinkled(problem, next.discrete->space, next.branch.unknowns)) {
        if (is_nearly_unstable(problem, next)) reason = Status::surface_unstable;
        observe(next, nullptr);
        break;  // this mesh cannot hold the state: the next one
      }
      state = next;
      ladder.add(problem, std::move(next));
      observe(ladder.rungs.back(), &ladder);
      if (is_accurate(ladder, problem)) return Status::converged;
    }
    if (ladder.rungs.empty() && !fresh.rungs.empty()) std::swap(ladder, fresh);
  }
  return reason;
}

}  // namespace rheocyte
