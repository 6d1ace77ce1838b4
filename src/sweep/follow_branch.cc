#include "sweep/follow_branch.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "sweep/branch_states.h"

namespace rheocyte {
namespace {

/// Steps of the samples in ln stiffness.
constexpr double first_step = 0.25, first_regularised_step = 0.08, max_step = 0.9, min_step = 2e-3;
/// So many states in a row may fail to be accurate before a branch is given up; each is nearer than the one before.
constexpr int max_unsampled = 4;
/// Of the step that the last interval would have allowed: towards its end a branch needs ever smaller ones.
constexpr double growth = 0.6;
/// Growth while one interval alone says nothing of the next: a state far beyond the wanted ones is dear.
constexpr double first_growth = 2;
/// A branch that is steeper than this (-d ln d / d ln E, of elongated cells that of the third mode) nears a fold: finer
/// meshes would not go farther.
constexpr double steep = 4;
/// Change of ln d between two samples against the trapezoidal rule of its slopes.
constexpr double max_mismatch = 0.15;
/// Between two samples the error of the interpolation may be this fraction of the accuracy.
constexpr double fraction_of_interpolation = 0.15;

/// Newton's failure at the end of a branch is the end of the branch.
BranchEnd end_after(Status failure) {
  const bool is_newton = failure == Status::iteration_limit || failure == Status::converged;
  return end_of(is_newton ? Status::branch_ended : failure);
}

class BranchSampler {
 public:
  BranchSampler(const TableSpec& spec, const SweepPoint& place, const std::atomic<bool>* stop)
      : spec_(spec), place_(place), stop_(stop), states_(spec, place, stop) {}

  /// From the nearly undeformed sphere.
  SampledBranch from_sphere() {
    const auto start = std::chrono::steady_clock::now();
    const BranchStates::Way way = states_.enter();
    return finish(way.status == Status::converged ? follow(way.last, first_step) : end_of(way.status), start);
  }

  /// From a stiffness on; the way there from the nearly undeformed sphere is not sampled.
  SampledBranch from_stiffness(double stiffness) {
    const auto start = std::chrono::steady_clock::now();
    BranchStates::Way way = states_.enter();
    if (way.status == Status::converged) way = states_.advance(way.last, std::log(states_.stiffness(0) / stiffness));
    return finish(way.status == Status::converged ? follow(way.last, first_regularised_step) : end_of(way.status),
                  start);
  }

 private:
  /// Samples the branch from a state on. A sample behind which the interpolation would not be accurate is given up,
  /// and a nearer one taken; where the branch ends is looked for once.
  BranchEnd follow(BranchNode first, double h) {
    if (!states_.refine(first) || !states_.measure(first)) return end_of(Status::accuracy_not_reached);
    nodes_.push_back(std::move(first));
    std::optional<BranchNode> last;  // the farthest state, once a step has failed
    Status failure = Status::not_started;
    int unsampled = 0;  // states in a row that were not accurate
    while (h > min_step / 2) {
      const BranchNode& before = nodes_.back();
      BranchNode next;
      if (last && last->u - before.u < 1.2 * h) {
        next = *last;
      } else {
        BranchStates::Way way = states_.advance(before, before.u + h);
        if (way.status == Status::stopped) return end_of(way.status);
        const bool moved = way.last.u > before.u + min_step / 4;
        if (moved && !states_.measure(way.last)) {
          // One state may fail where its neighbours do not.
          if (++unsampled > max_unsampled) return end_of(Status::accuracy_not_reached);
          h = 0.6 * (way.last.u - before.u);
          continue;
        }
        unsampled = 0;
        next = moved ? way.last : before;
        if (way.status != Status::converged) last = next, failure = way.status;
      }
      const double moved = next.u - before.u, allowed = moved > 0 ? allowed_step(before, next) : h;
      if (moved > 1.2 * allowed && 0.7 * allowed > min_step / 2) {
        h = 0.7 * allowed;
        continue;
      }
      if (moved > 0) keep(std::move(next));
      h = std::clamp(growth * allowed, 0.2 * moved, max_step);
      if (const std::optional<BranchEnd> end = leaves_range(nodes_.back())) return *end;
      if (!last || nodes_.back().u < last->u) continue;
      if (const std::optional<BranchEnd> end = ends_here(failure)) return *end;
      last.reset();
      h = std::max(h, 4 * min_step);
    }
    return end_of(Status::branch_ended);
  }

  void keep(BranchNode node) {
    nodes_.push_back(std::move(node));
    states_.release_coarser_than(nodes_.back().level);
  }

  /// At the farthest state of its resolution; otherwise the branch goes on at the next one.
  std::optional<BranchEnd> ends_here(Status failure) {
    BranchNode& node = nodes_.back();
    if (node.at(Measure::stability_margin) < small_margin) return end_of(Status::surface_unstable);
    if (log_progress_slope(node) > steep || !states_.refine(node)) return end_after(failure);
    return std::nullopt;
  }

  double log_progress(const BranchNode& node) const { return states_.log_progress(node); }
  double log_progress_slope(const BranchNode& node) const { return states_.log_progress_slope(node); }

  /// f4 of ln of the progress from the error of the cubic through both ends of [a, b] at c beyond b.
  double fourth_derivative(const BranchNode& a, const BranchNode& b, const BranchNode& c) const {
    const double H = b.u - a.u, h = c.u - b.u, t = 1 + h / H;
    const double h00 = (1 + 2 * t) * (1 - t) * (1 - t), h10 = t * (1 - t) * (1 - t), h01 = t * t * (3 - 2 * t),
                 h11 = t * t * (t - 1);
    const double cubic = h00 * log_progress(a) + h10 * H * log_progress_slope(a) + h01 * log_progress(b) +
                         h11 * H * log_progress_slope(b);
    return 24 * std::abs(log_progress(c) - cubic) / (h * h * (h + H) * (h + H));
  }

  /// The largest step behind which cubic interpolation is accurate, by the fourth derivative of ln of the progress.
  /// Where the trapezoidal rule is far off, too: another branch was reached, or a fold is near.
  double allowed_step(const BranchNode& before, const BranchNode& next) {
    const double h = next.u - before.u, change = log_progress(next) - log_progress(before);
    const double trapezoid = h * (log_progress_slope(before) + log_progress_slope(next)) / 2;
    double allowed = nodes_.size() < 2 ? first_growth / growth * h : max_step;
    if (std::abs(change - trapezoid) > max_mismatch * std::abs(change) + 1e-6) allowed = h / 2;
    const double wanted = fraction_of_interpolation * spec_.accuracy, off = middle_mismatch(before, next);
    if (off > wanted) allowed = std::min(allowed, h * std::max(0.4, std::cbrt(wanted / off)));
    if (nodes_.size() < 2) return allowed;
    const double f4 = std::max(fourth_derivative(nodes_[nodes_.size() - 2], before, next), 1e-12);
    return std::min(allowed, std::pow(384 * wanted / f4, 0.25));
  }

  /// The progress of the interpolated contour against the interpolated progress, relative, in the middle: the
  /// convex hull makes it less smooth than the contour where a dent appears.
  double middle_mismatch(const BranchNode& a, const BranchNode& b) {
    const auto is_convex = [](const BranchNode& node) {
      return node.at(Measure::deformation_raw) <= node.at(Measure::deformation) * (1 + 1e-5);
    };
    if ((is_convex(a) && is_convex(b)) || a.level != b.level || a.tangent.size() == 0) return 0;
    const double middle =
        (log_progress(a) + log_progress(b)) / 2 + (b.u - a.u) / 8 * (log_progress_slope(a) - log_progress_slope(b));
    return std::abs(std::log(states_.progress_in_the_middle(a, b)) - middle);
  }

  std::optional<BranchEnd> leaves_range(const BranchNode& node) const {
    const bool is_large = !spec_.is_combined() && node.at(Measure::area_um2) > 1.02 * spec_.max_area_um2;
    // Of elongated cells, what the flow adds to the deformation by the tension.
    const auto by_flow = [&](Measure m) { return node.at(m) - (spec_.is_elongated() ? nodes_.front().at(m) : 0); };
    if (by_flow(Measure::deformation) > spec_.max_deformation || is_large) return end_of(Status::covered);
    if (by_flow(Measure::deformation_raw) > spec_.max_deformation_raw) return end_of(Status::dented);
    return std::nullopt;
  }

  SampledBranch finish(const BranchEnd& end, std::chrono::steady_clock::time_point start) const {
    SampledBranch result;
    result.radius_um = place_.radius_um;
    result.cortex_fraction = place_.cortex_fraction;
    result.tension_ratio = place_.tension_ratio;
    result.axial_ratio = place_.axial_ratio;
    // A stop looks like a failure to whatever it interrupts.
    result.end = stop_ && *stop_ ? end_of(Status::stopped) : end;
    result.value.resize(Eigen::Index(nodes_.size()), measure_count);
    result.slope.resize(Eigen::Index(nodes_.size()), measure_count);
    for (const BranchNode& node : nodes_) {
      const Eigen::Index i = &node - nodes_.data();
      result.stiffness.push_back(states_.stiffness(node.u));
      result.value.row(i) = node.state.value.transpose();
      result.slope.row(i) = -node.slope.transpose();
      result.error.push_back(node.error);
      result.contour.push_back(node.state.contour);
      result.contour_slope.push_back(-node.contour_slope);
    }
    result.solves = states_.solves();
    result.newton_iterations = states_.newton_iterations();
    result.refused = states_.refused();
    result.factorisation_seconds = states_.factorisation_seconds();
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
  }

  TableSpec spec_;
  SweepPoint place_;
  const std::atomic<bool>* stop_;
  BranchStates states_;
  std::vector<BranchNode> nodes_;
};

}  // namespace

SampledBranch follow_branch(const TableSpec& spec, const SweepPoint& place, std::optional<double> first_stiffness,
                            const std::atomic<bool>* stop) {
  BranchSampler sampler(spec, place, stop);
  return first_stiffness ? sampler.from_stiffness(*first_stiffness) : sampler.from_sphere();
}

}  // namespace rheocyte
