#include "solve/duct_branch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "solve/duct_solver.h"
#include "solve/surface_stability.h"

namespace rheocyte {
namespace {

/// At the same compliance cells of higher degrees deform a few per cent less: the way goes so far beyond what is
/// wanted.
constexpr double share_beyond = 1.06;
/// The end found at the first degree is not quite that of the higher ones: the last state stays before it, and steps
/// back where it is beyond.
constexpr double share_of_end = 0.97, step_back = 0.95;
constexpr int max_steps_back = 14;
/// States above are more accurate where the last one is farther from the end; an error of those below stays with them.
constexpr double soft_height = 0.6;
/// A branch whose last state is closer than this to what is wanted covers it.
constexpr double share_covered = 0.97;
/// Of the compliance: so closely the end is looked for.
constexpr double min_step = 0.01;

/// A state of the way at the first degree.
struct Milestone {
  double compliance, deformation;
  VectorXd unknowns;
};

class DuctBranchFollower {
 public:
  DuctBranchFollower(const Problem& problem, const MediaAt& media, double max_deformation, double least_margin,
                     const std::atomic<bool>* stop)
      : wanted_(max_deformation),
        least_margin_(least_margin),
        solver_(problem, media, nobody_, stop, counts_),
        stop_(stop) {
    solver_.keep_systems();
    solver_.want_stable();
  }

  DuctBranch follow(std::span<const double> heights) {
    DuctBranch branch;
    branch.end = walk();
    if (way_.empty() || is_stopped()) return branch;
    double last = is_passed() ? share_beyond * wanted_ : share_of_end * way_.back().deformation;
    for (int attempt = 0; branch.states.empty() && !is_stopped() && attempt <= max_steps_back; ++attempt) {
      if (attempt > 0) last *= step_back;
      branch.states = states_to(last, heights);
    }
    if (branch.states.empty()) return branch;
    const StationaryState& softest = branch.states.back();
    if (branch.end == Status::converged && softest.shape.deformation < share_covered * wanted_)
      branch.end = is_at_limit(softest.stability_margin) ? Status::surface_unstable : Status::accuracy_not_reached;
    return branch;
  }

 private:
  bool is_stopped() const { return stop_ && *stop_; }
  bool is_at_limit(double margin) const { return margin < least_margin_ + small_margin; }
  bool is_passed() const { return !way_.empty() && way_.back().deformation > share_beyond * wanted_; }

  /// Nothing if the end is too near for one of the states.
  std::vector<StationaryState> states_to(double last, std::span<const double> heights) {
    std::vector<StationaryState> states;
    for (auto height = heights.rbegin(); height != heights.rend(); ++height) {
      auto state = state_of(*height * *height * last);
      const bool gains = *height > soft_height;
      if (!state || is_stopped() || (gains && state->outcome.status != Status::converged)) return {};
      states.push_back(std::move(*state));
    }
    std::ranges::reverse(states);
    return states;
  }

  /// At the first degree from the sphere on.
  Status walk() {
    ContinuationOptions options = solver_.options(false, least_margin_);
    options.min_step = min_step;
    options.accept = [this, is_good = options.accept](const NonlinearSystem& system, const BranchState& state) {
      if (!is_good(system, state)) return false;
      const double d = counts_.branch.back().deformation;
      if (d > 1.3 * share_beyond * wanted_) return false;  // rather a nearer one
      way_.push_back({state.parameter, d, state.unknowns});
      return true;
    };
    first_ = solver_.enter(DuctSolver::first_degree, options);
    if (first_.status != Status::converged) return first_.status;
    DuctState state = first_;
    while (state.status == Status::converged && !is_passed())
      solver_.advance(state, 1.5 * state.branch.parameter, options);
    return way_.back().deformation > wanted_ ? Status::converged : reason(state);
  }

  Status reason(const DuctState& state) const {
    if (state.status == Status::stopped) return state.status;
    const Milestone& last = way_.back();
    if (is_at_limit(solver_.stability_margin(last.compliance, state.discrete->space, last.unknowns)))
      return Status::surface_unstable;
    return state.status == Status::iteration_limit ? Status::branch_ended : state.status;
  }

  /// The state whose deformation is about this at the first degree; nothing if it is not one at the higher ones.
  std::optional<StationaryState> state_of(double deformation) {
    StationaryState result;
    solver_.count_in(result);
    const Milestone guess = guess_of(deformation);
    DuctState state = solver_.at_compliance(first_, guess.compliance, guess.unknowns);
    DuctLadder ladder;
    if (state.status == Status::converged) result.outcome.status = solver_.climb(state, ladder);
    const Problem here = solver_.problem_at(guess.compliance);
    if (!has_state(result.outcome.status)) return {};
    describe_duct(here, *state.discrete, state.branch.unknowns, result);
    result.write_fields = {};
    result.outcome.reached = guess.compliance;
    return result;
  }

  Milestone guess_of(double deformation) const {
    const auto beyond = std::ranges::lower_bound(way_, deformation, {}, &Milestone::deformation);
    if (beyond == way_.end()) return way_.back();
    if (beyond == way_.begin()) {
      // d goes with the square of the compliance, displacements with the compliance.
      Milestone guess{way_.front().compliance * std::sqrt(deformation / way_.front().deformation), deformation,
                      way_.front().unknowns};
      first_.discrete->system.scale_displacement(guess.compliance / way_.front().compliance, guess.unknowns);
      return guess;
    }
    const Milestone &a = *(beyond - 1), &b = *beyond;
    const double share = std::log(deformation / a.deformation) / std::log(b.deformation / a.deformation);
    const double compliance = a.compliance * std::pow(b.compliance / a.compliance, share);
    const double way = (compliance - a.compliance) / (b.compliance - a.compliance);
    return {compliance, deformation, (1 - way) * a.unknowns + way * b.unknowns};
  }

  double wanted_, least_margin_;
  StationaryState counts_;
  ProgressCallback nobody_;
  DuctSolver solver_;
  const std::atomic<bool>* stop_;
  DuctState first_;
  std::vector<Milestone> way_;
};

}  // namespace

DuctBranch follow_in_duct(const Problem& problem, const MediaAt& media, double max_deformation,
                          std::span<const double> heights, double least_margin, const std::atomic<bool>* stop) {
  return DuctBranchFollower(problem, media, max_deformation, least_margin, stop).follow(heights);
}

}  // namespace rheocyte
