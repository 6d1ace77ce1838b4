#include "solve/equilibrium_offset.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "case/scales.h"
#include "numeric/roots.h"

namespace rheocyte {
namespace {

// In h.
constexpr double place_tolerance = 1e-3, first_step = 0.1, nearly_on_axis = 0.02;
constexpr double coarse_accuracy = 1e-2;
constexpr int max_corrections = 6;

/// Whether its drift is known; a surface beyond its limit on the way does not end the search, but at its end it counts.
bool is_solved(const StationaryState& state) { return has_wanted_moduli(state.outcome); }

/// Between which offsets the outward drift changes from positive to negative.
struct Bracket {
  double inner, outer;
};

class OffsetSearch {
 public:
  OffsetSearch(const Problem& problem, const SolveAtOffset& solve)
      : problem_(problem), solve_(solve), side_(problem.offset > 0 ? 1 : -1) {
    const Extent& extent = problem.extent;
    const double half = problem.camera == Camera::side ? extent.height : extent.width;
    max_offset_ = max_offset(half, problem.radius_ratio);
    min_offset_ = std::min(nearly_on_axis, max_offset_ / 2);
  }

  /// Away from the axis; 0 where no state is found, which ends every search.
  double drift_at(double offset) {
    const auto [known, is_new] = seen_.try_emplace(offset);
    if (is_new) {
      problem_.offset = side_ * offset;
      solve();
      known->second = last_;
      if (!is_solved(last_)) known->second.drift_velocity = 0;
    }
    return side_ * known->second.drift_velocity;
  }
  /// How much the numbers differ between the ends of a bracket that was found.
  StateNumbers change_over(const Bracket& bracket) const {
    return distance(seen_.at(bracket.inner), seen_.at(bracket.outer));
  }

  /// Steps along the drift until it turns round; nothing at the axis, at the wall, and where no state is found.
  std::optional<Bracket> bracket() {
    double offset = std::abs(problem_.offset), drift = drift_at(offset);
    for (double step = first_step; drift != 0; step *= 1.5) {
      const bool outward = drift > 0;
      if (outward ? offset >= max_offset_ : is_on_axis()) return std::nullopt;
      const double next = std::clamp(outward ? offset + step : offset - step, min_offset_, max_offset_);
      drift = drift_at(next);
      if (drift != 0 && (drift > 0) != outward) return outward ? Bracket{offset, next} : Bracket{next, offset};
      offset = next;
    }
    return std::nullopt;
  }

  void set_accuracy(double accuracy) {
    problem_.accuracy = accuracy;
    seen_.clear();
  }
  const StationaryState& last() const { return last_; }
  double offset() const { return std::abs(problem_.offset); }
  bool is_on_axis() const { return offset() <= min_offset_; }

  StationaryState on_axis() {
    problem_.offset = 0;
    solve();
    last_.offset = last_.drift_velocity = 0;
    return result();
  }
  /// The last state, with the work of all.
  StationaryState result() {
    last_.statistics = work_;
    return last_;
  }

 private:
  void solve() {
    last_ = solve_(problem_);
    work_ += last_.statistics;
  }

  Problem problem_;
  const SolveAtOffset& solve_;
  double side_, min_offset_, max_offset_;
  std::map<double, StateNumbers> seen_;  ///< at the places where they are known; drifts are 0 where there is no state
  StationaryState last_;
  SolveStatistics work_;
};

/// Goes to the place, from that and the slope of a coarser solution, and says how far off it may be still: the
/// tolerance where the search has settled; nothing where no state is found.
std::optional<double> correct(double offset, double slope, OffsetSearch& search) {
  double drift = search.drift_at(offset);
  for (int i = 0; i < max_corrections && is_solved(search.last()); ++i) {
    const double next = offset - drift / slope;
    if (std::abs(next - offset) < place_tolerance) return place_tolerance;
    const double drift_there = search.drift_at(next);
    slope = (drift_there - drift) / (next - offset);
    offset = next, drift = drift_there;
  }
  if (!is_solved(search.last())) return std::nullopt;
  return std::abs(drift / slope);
}

void say_unsettled(const Problem& problem, double left, Outcome& outcome) {
  outcome.status = judged(outcome.status, {.estimated_error = left, .wanted_error = place_tolerance});
  outcome.message += fmt::format(
      " The search for the place where it does not drift has not settled: its next step would be {:.2g} of the cell's "
      "radius; start it closer to that place (cell.offset_um), or with a smaller numerics.accuracy.",
      left / problem.radius_ratio);
}

}  // namespace

StationaryState solve_at_equilibrium(const Problem& problem, const SolveAtOffset& solve) {
  OffsetSearch search(problem, solve);
  search.set_accuracy(std::max(10 * problem.accuracy, coarse_accuracy));
  const std::optional<Bracket> bracket = search.bracket();
  if (!bracket) {
    if (!is_solved(search.last())) return search.result();
    search.set_accuracy(problem.accuracy);
    if (search.is_on_axis()) {
      StationaryState state = search.on_axis();
      if (is_solved(state)) state.outcome.message += " The cell drifts to the axis.";
      return state;
    }
    StationaryState state = search.result();
    state.outcome.status = Status::no_equilibrium;
    state.outcome.message = fmt::format(
        "The cell drifts towards the wall beyond the maximum offset that can be solved, {:.3g} of its radius; there is "
        "no equilibrium before.",
        search.offset() / problem.radius_ratio);
    return state;
  }
  const auto drift = [&](double offset) { return search.drift_at(offset); };
  const double slope = (drift(bracket->outer) - drift(bracket->inner)) / (bracket->outer - bracket->inner);
  const double coarse = bracketed_root(drift, bracket->inner, bracket->outer, place_tolerance);
  if (!is_solved(search.last())) return search.result();
  const StateNumbers change = search.change_over(*bracket);
  search.set_accuracy(problem.accuracy);
  const std::optional<double> left = correct(coarse, slope, search);
  StationaryState state = search.result();
  if (!left) return state;
  state.offset_error = std::abs(search.offset() - coarse) + *left;
  add_errors(state.offset_error / (bracket->outer - bracket->inner), change, state.errors);
  state.errors.offset = state.offset_error;
  if (*left > place_tolerance) say_unsettled(problem, *left, state.outcome);
  return state;
}

}  // namespace rheocyte
