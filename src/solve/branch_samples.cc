#include "solve/branch_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "solve/resolved_branch.h"
#include "solve/surface_stability.h"

namespace rheocyte {
namespace {

/// At the same compliance cells of higher degrees deform a few per cent less: the way goes so far beyond what is
/// wanted.
constexpr double fraction_beyond = 1.06;
/// The end found at the first degree is not quite that of the higher ones: the last state stays before it, and steps
/// back where it is beyond.
constexpr double fraction_of_end = 0.97, step_back = 0.95;
constexpr int max_steps_back = 14;
/// States above are more accurate where the last one is farther from the end; an error of those below stays with them.
constexpr double soft_height = 0.6;
/// A branch whose last state is closer than this to what is requested covers it.
constexpr double fraction_covered = 0.97;
/// Of the compliance: so closely the end is looked for.
constexpr double min_step = 0.01;

/// A state of the way at its resolution, the first that is none of a scout.
struct Milestone {
  double compliance, height;  ///< as SamplingWay has it, but not relative
  std::shared_ptr<Discrete> discrete;
  VectorXd unknowns;
};

class BranchFollower {
 public:
  BranchFollower(const Problem& problem, const MediaAt& media, const SamplingWay& wanted, const std::atomic<bool>* stop)
      : wanted_(wanted), branch_(problem, media, judging(solver_geometry(problem)), {}, stop) {}

  BranchSamples follow() {
    BranchSamples branch;
    branch.end = walk();
    if (way_.empty() || is_stopped()) return branch;
    double last = is_passed() ? height_of(fraction_beyond * wanted_.max_deformation, way_.back().compliance)
                              : height_of(fraction_of_end) * way_.back().height;
    for (int attempt = 0; branch.states.empty() && !is_stopped() && attempt <= max_steps_back; ++attempt) {
      if (attempt > 0) last *= height_of(step_back);
      branch.states = states_to(last);
    }
    if (branch.states.empty()) return branch;
    const StationaryState& softest = branch.states.back();
    if (branch.end == Status::converged && softest.shape.deformation < fraction_covered * wanted_.max_deformation)
      branch.end = is_at_limit(softest.stability_margin) || is_unstable_beyond_ ? Status::surface_unstable
                                                                                : Status::accuracy_not_reached;
    return branch;
  }

 private:
  bool is_stopped() const { return branch_.is_stopped(); }
  bool is_at_limit(double margin) const { return margin < wanted_.least_margin + small_margin; }
  bool is_passed() const { return last_deformation_ > fraction_beyond * wanted_.max_deformation; }

  bool goes_by_deformation() const { return wanted_.height == SamplingWay::Height::root_of_deformation; }
  double height_of(double deformation, double compliance) const {
    return goes_by_deformation() ? std::sqrt(deformation) : compliance;
  }
  /// Of a fraction of the deformation; near the end of a branch the compliance goes about as the deformation's root.
  double height_of(double fraction) const { return std::sqrt(fraction); }

  /// At its last degree, too.
  bool is_wanted(const StationaryState& state) const {
    return state.outcome.status == Status::converged && state.stability_margin >= wanted_.least_margin;
  }

  /// Nothing if the end is too near for one of the states.
  std::vector<StationaryState> states_to(double last) {
    std::vector<StationaryState> states;
    for (auto height = wanted_.heights.rbegin(); height != wanted_.heights.rend(); ++height) {
      auto state = state_of(*height * last);
      const bool gains = *height > soft_height;
      if (!state || is_stopped() || (gains && !is_wanted(*state))) return {};
      states.push_back(std::move(*state));
    }
    std::ranges::reverse(states);
    return states;
  }

  /// Near the limit of stability higher degrees take turns in being beyond it.
  static Geometry judging(Geometry geometry) {
    geometry.judges_rungs = true;
    return geometry;
  }

  bool accept(Discrete& discrete, const BranchState& state) {
    const Problem here = branch_.problem_at(state.parameter);
    if (discrete.stability_margin(here, state.unknowns) < wanted_.least_margin) return false;
    const double d = discrete.deformation(here, state.unknowns);
    if (d > 1.3 * fraction_beyond * wanted_.max_deformation) return false;  // rather a nearer one
    way_.push_back({state.parameter, height_of(d, state.parameter), discrete.shared_from_this(), state.unknowns});
    last_deformation_ = d;
    return true;
  }

  /// From the sphere on.
  Status walk() {
    const ContinuationOptions options = branch_.options(min_step);
    const auto to_accept = [this](Discrete& discrete, const BranchState& state) { return accept(discrete, state); };
    const auto& ways = branch_.geometry().ways;
    const auto first_way = std::ranges::find(ways, false, &CoarseWay::is_scout);
    first_ = branch_.start(first_way->resolution, options, to_accept);
    if (first_.status != Status::converged) return first_.status;
    ResolvedState state = first_;
    if (state.branch.parameter < wanted_.first_compliance) {
      branch_.advance(state, wanted_.first_compliance, options, to_accept);
      first_ = state;
    }
    while (state.status == Status::converged && !is_passed())
      branch_.advance(state, 1.5 * state.branch.parameter, options, to_accept);
    return last_deformation_ > wanted_.max_deformation ? Status::converged : reason(state);
  }

  Status reason(const ResolvedState& state) const {
    if (state.status == Status::stopped) return state.status;
    const Milestone& last = way_.back();
    if (is_at_limit(state.discrete->stability_margin(branch_.problem_at(last.compliance), last.unknowns)))
      return Status::surface_unstable;
    return state.status == Status::iteration_limit ? Status::branch_ended : state.status;
  }

  /// The state that is about so high at the first degree; nothing if it is not one at the higher ones.
  std::optional<StationaryState> state_of(double height) {
    const Milestone guess = guess_of(height);
    branch_.take_statistics();
    ResolvedState state = branch_.solved(guess.discrete, guess.compliance, guess.unknowns, branch_.geometry().across);
    Ladder ladder{branch_.geometry().errors};
    StationaryState result;
    if (state.status == Status::converged) result.outcome.status = branch_.climb(state, ladder);
    is_unstable_beyond_ = is_unstable_beyond_ || result.outcome.status == Status::surface_unstable;
    if (!has_state(result.outcome.status)) return {};
    result.statistics = branch_.take_statistics();
    const Problem here = branch_.problem_at(guess.compliance);
    state.discrete->describe(here, state.branch.unknowns, result);
    result.estimated_error = ladder.stated_error(here);
    result.deformation_floor = deformation_floor(here);
    result.errors = ladder.errors();
    result.write_fields = {};
    result.outcome.reached = guess.compliance;
    return result;
  }

  Milestone guess_of(double height) const {
    const auto beyond = std::ranges::lower_bound(way_, height, {}, &Milestone::height);
    if (beyond == way_.end()) return way_.back();
    if (beyond == way_.begin()) {
      // d goes with the square of the compliance, displacements with the compliance.
      Milestone guess = way_.front();
      const double fraction = height / guess.height;
      guess.compliance *= fraction;
      guess.height = height;
      guess.discrete->system().scale_displacement(fraction, guess.unknowns);
      return guess;
    }
    const Milestone &a = *(beyond - 1), &b = *beyond;
    const double fraction = std::log(height / a.height) / std::log(b.height / a.height);
    const double compliance = a.compliance * std::pow(b.compliance / a.compliance, fraction);
    const double way = (compliance - a.compliance) / (b.compliance - a.compliance);
    const VectorXd before = a.discrete == b.discrete ? a.unknowns : b.discrete->transfer_from(*a.discrete, a.unknowns);
    return {compliance, height, b.discrete, (1 - way) * before + way * b.unknowns};
  }

  const SamplingWay& wanted_;
  ResolvedBranch branch_;
  ResolvedState first_;
  std::vector<Milestone> way_;
  double last_deformation_ = 0;
  bool is_unstable_beyond_ = false;  ///< at higher degrees, where the first one has a state
};

}  // namespace

BranchSamples branch_samples(const Problem& problem, const MediaAt& media, const SamplingWay& wanted,
                             const std::atomic<bool>* stop) {
  return BranchFollower(problem, media, wanted, stop).follow();
}

}  // namespace rheocyte
