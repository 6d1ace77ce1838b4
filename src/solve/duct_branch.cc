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
  double compliance, height;  ///< as DuctBranchWay has it, but not relative
  VectorXd unknowns;
};

class DuctBranchFollower {
 public:
  DuctBranchFollower(const Problem& problem, const MediaAt& media, const DuctBranchWay& wanted,
                     const std::atomic<bool>* stop)
      : wanted_(wanted), solver_(problem, media, nobody_, stop, counts_), stop_(stop) {
    solver_.keep_systems();
    solver_.want_stable();
  }

  DuctBranch follow() {
    DuctBranch branch;
    branch.end = walk();
    if (way_.empty() || is_stopped()) return branch;
    double last = is_passed() ? height_of(share_beyond * wanted_.max_deformation, way_.back().compliance)
                              : height_of(share_of_end) * way_.back().height;
    for (int attempt = 0; branch.states.empty() && !is_stopped() && attempt <= max_steps_back; ++attempt) {
      if (attempt > 0) last *= height_of(step_back);
      branch.states = states_to(last);
    }
    if (branch.states.empty()) return branch;
    const StationaryState& softest = branch.states.back();
    if (branch.end == Status::converged && softest.shape.deformation < share_covered * wanted_.max_deformation)
      branch.end = is_at_limit(softest.stability_margin) ? Status::surface_unstable : Status::accuracy_not_reached;
    return branch;
  }

 private:
  bool is_stopped() const { return stop_ && *stop_; }
  bool is_at_limit(double margin) const { return margin < wanted_.least_margin + small_margin; }
  bool is_passed() const { return last_deformation_ > share_beyond * wanted_.max_deformation; }

  bool goes_by_deformation() const { return wanted_.height == DuctBranchWay::Height::root_of_deformation; }
  double height_of(double deformation, double compliance) const {
    return goes_by_deformation() ? std::sqrt(deformation) : compliance;
  }
  /// Of a share of the deformation; near the end of a branch the compliance goes about as the deformation's root.
  double height_of(double share) const { return std::sqrt(share); }

  /// Nothing if the end is too near for one of the states.
  std::vector<StationaryState> states_to(double last) {
    std::vector<StationaryState> states;
    for (auto height = wanted_.heights.rbegin(); height != wanted_.heights.rend(); ++height) {
      auto state = state_of(*height * last);
      const bool gains = *height > soft_height;
      if (!state || is_stopped() || (gains && state->outcome.status != Status::converged)) return {};
      states.push_back(std::move(*state));
    }
    std::ranges::reverse(states);
    return states;
  }

  /// At the first degree from the sphere on.
  Status walk() {
    ContinuationOptions options = solver_.options(false, wanted_.least_margin);
    options.min_step = min_step;
    options.accept = [this, is_good = options.accept](const NonlinearSystem& system, const BranchState& state) {
      if (!is_good(system, state)) return false;
      const double d = counts_.branch.back().deformation;
      if (d > 1.3 * share_beyond * wanted_.max_deformation) return false;  // rather a nearer one
      way_.push_back({state.parameter, height_of(d, state.parameter), state.unknowns});
      last_deformation_ = d;
      return true;
    };
    first_ = solver_.enter(DuctSolver::first_degree, options);
    if (first_.status != Status::converged) return first_.status;
    DuctState state = first_;
    if (state.branch.parameter < wanted_.first_compliance) {
      solver_.advance(state, wanted_.first_compliance, options);
      first_ = state;
    }
    while (state.status == Status::converged && !is_passed())
      solver_.advance(state, 1.5 * state.branch.parameter, options);
    return last_deformation_ > wanted_.max_deformation ? Status::converged : reason(state);
  }

  Status reason(const DuctState& state) const {
    if (state.status == Status::stopped) return state.status;
    const Milestone& last = way_.back();
    if (is_at_limit(solver_.stability_margin(last.compliance, state.discrete->space, last.unknowns)))
      return Status::surface_unstable;
    return state.status == Status::iteration_limit ? Status::branch_ended : state.status;
  }

  /// The state that is about so high at the first degree; nothing if it is not one at the higher ones.
  std::optional<StationaryState> state_of(double height) {
    StationaryState result;
    solver_.count_in(result);
    const Milestone guess = guess_of(height);
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

  Milestone guess_of(double height) const {
    const auto beyond = std::ranges::lower_bound(way_, height, {}, &Milestone::height);
    if (beyond == way_.end()) return way_.back();
    if (beyond == way_.begin()) {
      // d goes with the square of the compliance, displacements with the compliance.
      Milestone guess{way_.front().compliance * height / way_.front().height, height, way_.front().unknowns};
      first_.discrete->system.scale_displacement(guess.compliance / way_.front().compliance, guess.unknowns);
      return guess;
    }
    const Milestone &a = *(beyond - 1), &b = *beyond;
    const double share = std::log(height / a.height) / std::log(b.height / a.height);
    const double compliance = a.compliance * std::pow(b.compliance / a.compliance, share);
    const double way = (compliance - a.compliance) / (b.compliance - a.compliance);
    return {compliance, height, (1 - way) * a.unknowns + way * b.unknowns};
  }

  const DuctBranchWay& wanted_;
  StationaryState counts_;
  ProgressCallback nobody_;
  DuctSolver solver_;
  const std::atomic<bool>* stop_;
  DuctState first_;
  std::vector<Milestone> way_;
  double last_deformation_ = 0;
};

}  // namespace

DuctBranch follow_in_duct(const Problem& problem, const MediaAt& media, const DuctBranchWay& wanted,
                          const std::atomic<bool>* stop) {
  return DuctBranchFollower(problem, media, wanted, stop).follow();
}

}  // namespace rheocyte
