#include "sweep/follow_branch.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "numeric/hermite.h"
#include "sweep/accurate_step.h"
#include "sweep/branch_states.h"

namespace rheocyte {
namespace {

/// Steps of the samples in ln stiffness.
constexpr double first_step = 1, first_regularised_step = 0.08, max_step = 1.6;
/// So many states in a row may fail to be accurate before a branch is given up; each is nearer than the one before.
constexpr int max_unsampled = 4;
/// Of the step that the last interval would have allowed: towards its end a branch needs ever smaller ones.
constexpr double growth = 0.75;
/// A step that is longer than allowed by more than this is taken again; the error grows with its eighth power.
constexpr double excess = 1.1;
/// Growth while one interval alone says nothing of the next: a state far beyond the requested ones is dear.
constexpr double first_growth = 2;
/// A branch that is steeper than this (-d ln d / d ln E, of elongated cells that of the third mode) nears a fold: finer
/// meshes would not go farther.
constexpr double steep = 4;
/// A bare branch ends where the margin of its surface's stability has come down to this; half of it is aimed at.
constexpr double end_margin = 0.01;
/// A branch that is steeper than this turns back: softer cells are elongated without limit.
constexpr double turning = 12;
/// Of one interval of the compliance over the one before.
constexpr double interval_growth = 2;
/// Limits of growing measures are passed by this.
constexpr double beyond = 1.01;
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
      : spec_(spec), place_(place), stop_(stop), states_(spec, place, stop), min_step_(2 * states_.least_advance()) {}

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
    if (way.status == Status::converged) way = states_.walk(way.last, std::log(states_.stiffness(0) / stiffness));
    return finish(way.status == Status::converged ? follow(way.last, first_regularised_step) : end_of(way.status),
                  start);
  }

 private:
  /// Samples the branch from a state on. A sample behind which the interpolation would not be accurate waits until
  /// nearer ones have been taken; where the branch ends is looked for once.
  BranchEnd follow(BranchNode first, double h) {
    if (!states_.refine(first) || !states_.measure(first)) return end_of(Status::accuracy_not_reached);
    nodes_.push_back(std::move(first));
    int unsampled = 0;  // states in a row that were not accurate
    while (h > min_step_ / 2) {
      const BranchNode& before = nodes_.back();
      BranchStates::Way way = next_state(h);
      if (way.status == Status::stopped) return end_of(way.status);
      BranchNode& next = way.last;
      const double moved = next.u - before.u;
      if (next.state.value.size() == 0 && moved > min_step_ / 4 && !states_.measure(next)) {
        // One state may fail where its neighbours do not.
        if (++unsampled > max_unsampled) return end_of(Status::accuracy_not_reached);
        h = 0.6 * moved;
        continue;
      }
      unsampled = 0;
      if (way.status != Status::converged) failure_ = way.status;
      const bool has_moved = moved > min_step_ / 4;
      const double allowed = has_moved ? allowed_step(before, next) : h;
      // A nearer state than this one; what lies within the shortest step is as near as any.
      const double nearer = std::max(growth * allowed, min_step_);
      if (moved > excess * std::max(allowed, nearer) && growth * allowed > min_step_ / 2) {
        h = nearer;
        ahead_.push_back(std::move(next));
        continue;
      }
      if (has_moved) keep(std::move(next));
      h = std::clamp(growth * allowed, 0.2 * moved, max_step);
      if (const std::optional<BranchEnd> end = end_at(nodes_.back())) return *end;
      if (failure_ == Status::converged || !ahead_.empty()) continue;
      if (const std::optional<BranchEnd> end = ends_here(failure_)) return *end;
      failure_ = Status::converged;
      h = std::max(h, 4 * min_step_);
    }
    return end_of(Status::branch_ended);
  }

  /// A state about `h` ahead of the last node: one that waits, one before it, or, where none does, as far as the branch
  /// goes.
  BranchStates::Way next_state(double h) {
    const BranchNode& before = nodes_.back();
    h = std::max(min_step_, std::min({h, distance_of_end(before), grown_step()}));
    if (ahead_.empty()) return states_.advance(before, before.u + h);
    if (ahead_.back().u - before.u > excess * h) {
      BranchStates::Way way = states_.between(before, ahead_.back(), before.u + h);
      return way.status == Status::converged ? way : states_.advance(before, before.u + h);
    }
    BranchStates::Way way{Status::converged, std::move(ahead_.back())};
    ahead_.pop_back();
    return way;
  }

  /// Far from the undeformed cell polynomials in the compliance know little of states that are all near to it.
  double grown_step() const {
    if (nodes_.size() < 2) return HUGE_VAL;
    return std::log1p(interval_growth * -std::expm1(nodes_[nodes_.size() - 2].u - nodes_.back().u));
  }

  void keep(BranchNode node) {
    nodes_.push_back(std::move(node));
    states_.release_coarser_than(nodes_.back());
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

  /// The largest step behind which the dense output is accurate. Where the trapezoidal rule is far off, too: another
  /// branch was reached, or a fold is near.
  double allowed_step(const BranchNode& before, const BranchNode& next) {
    const double h = next.u - before.u, change = log_progress(next) - log_progress(before);
    const double trapezoid = h * (log_progress_slope(before) + log_progress_slope(next)) / 2;
    const double wanted = fraction_of_interpolation * states_.admitted_error(next);
    const bool is_far = std::abs(change - trapezoid) > max_mismatch * std::abs(change) + 1e-6;
    return std::min(is_far ? h / 2 : max_step, accurate_step_from(before, next, wanted));
  }

  double accurate_step_from(const BranchNode& before, const BranchNode& next, double wanted) {
    std::vector<SamplePoint> points{point(next)};
    for (auto node = nodes_.rbegin(); node != nodes_.rend() && dented(*node) == dented(next); ++node)
      points.push_back(point(*node));
    std::ranges::reverse(points);
    if (points.size() > 2) return accurate_step(points, {states_.power()}, wanted, max_step);
    const double h = next.u - before.u, off = difference_of_cubics(before, next);
    return std::min(first_growth / growth, std::cbrt(wanted / off)) * h;
  }

  SamplePoint point(const BranchNode& node) const { return {node.u, log_progress(node), log_progress_slope(node)}; }

  static bool dented(const BranchNode& node) {
    return is_dented(node.at(Measure::deformation), node.at(Measure::deformation_raw));
  }

  /// Between two states the first of which stands alone, or where a dent appears, which makes what is measured on the
  /// hull less smooth than the outline: how far the progress of a cubic through the states is from the cubic of the
  /// progress.
  double difference_of_cubics(const BranchNode& a, const BranchNode& b) {
    const double way = std::expm1(b.u - a.u), power = states_.power();
    const double slope = way * (log_progress_slope(a) - power);
    const double end_slope = way / (1 + way) * (log_progress_slope(b) - power);
    double greatest = 0;
    for (const double part : {0.25, 0.5, 0.75, 0.9}) {
      const double cubic = hermite(part)(log_progress(a), log_progress(b) - power * (b.u - a.u), slope, end_slope);
      const double found = states_.log_progress_between(a, b, part) - power * std::log1p(part * way);
      greatest = std::max(greatest, std::abs(found - cubic));
    }
    return greatest;
  }

  /// A measure at which a branch ends; what is aimed at lies a little beyond.
  struct Limit {
    Measure measure;
    double value, aim;
    Status end;

    bool is_passed(double by) const { return aim > value ? by > value : by < value; }
  };

  std::vector<Limit> limits() const {
    // Of elongated cells, what the flow adds to the deformation by the tension.
    const auto by_tension = [&](Measure m) { return spec_.is_elongated() ? nodes_.front().at(m) : 0; };
    const double deformation = spec_.max_deformation + by_tension(Measure::deformation);
    const double raw = spec_.max_deformation_raw + by_tension(Measure::deformation_raw);
    std::vector<Limit> limits{{Measure::deformation, deformation, beyond * deformation, Status::covered},
                              {Measure::deformation_raw, raw, beyond * raw, Status::dented},
                              {Measure::stability_margin, end_margin, end_margin / 2, Status::surface_unstable}};
    const double area = 1.02 * spec_.max_area_um2;
    if (!spec_.is_combined()) limits.push_back({Measure::area_um2, area, beyond * area, Status::covered});
    return limits;
  }

  std::optional<BranchEnd> end_at(const BranchNode& node) const {
    for (const Limit& limit : limits())
      if (limit.is_passed(node.at(limit.measure))) return end_of(limit.end);
    if (log_progress_slope(node) > turning) return end_of(Status::limit_point);
    return std::nullopt;
  }

  /// To the first limit that the branch comes to, by the slopes of its measures.
  double distance_of_end(const BranchNode& node) const {
    double nearest = HUGE_VAL;
    for (const Limit& limit : limits()) {
      const double distance = (limit.aim - node.at(limit.measure)) / node.slope(int(limit.measure));
      if (distance > 0) nearest = std::min(nearest, distance);
    }
    return nearest;
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
  double min_step_;  ///< of the samples, in ln stiffness
  std::vector<BranchNode> nodes_;
  std::vector<BranchNode> ahead_;       ///< measured, but too far away; the nearest one last
  Status failure_ = Status::converged;  ///< of the step beyond the farthest state
};

}  // namespace

SampledBranch follow_branch(const TableSpec& spec, const SweepPoint& place, std::optional<double> first_stiffness,
                            const std::atomic<bool>* stop) {
  BranchSampler sampler(spec, place, stop);
  return first_stiffness ? sampler.from_stiffness(*first_stiffness) : sampler.from_sphere();
}

}  // namespace rheocyte
