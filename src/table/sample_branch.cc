#include "table/sample_branch.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

#include "case/scales.h"
#include "solve/resolved_branch.h"
#include "table/measured_state.h"

namespace rheocyte {
namespace {

/// Ever finer resolutions; a state is accurate if the one before gives the same deformation.
const std::array<Resolution, 5> ladder = {
    {{{2, 4, 1, 2}, 6}, {{2, 4, 1, 2}, 8}, {{3, 6, 1, 2}, 8}, {{3, 6, 1, 2}, 10}, {{4, 8, 2, 2}, 10}}};
constexpr int first_level = 1;
/// The error of a level is taken as this share of the change from the level before.
constexpr double share_of_change = 0.5;
constexpr double tolerance = 1e-10;
/// Displacement of the first state, in r0; its deformation is some 1e-5.
constexpr double first_displacement = 0.006;
/// Steps of the samples in ln stiffness.
constexpr double first_step = 0.25, greatest_step = 0.6, least_step = 2e-3;
/// Between two samples the error of the interpolation may be this share of the accuracy.
constexpr double share_of_interpolation = 0.5;

/// A state at u = ln(first stiffness / stiffness).
struct Node {
  double u = 0;
  VectorXd unknowns, tangent;  ///< d/du
  MeasuredState state;
  Eigen::VectorXd slope;          ///< d(value)/du
  Eigen::MatrixX2d contour_slope;
  double error = 0;
  double log_d() const { return std::log(state.value(0)); }
  double log_d_slope() const { return slope(0) / state.value(0); }
};

/// f4 of a function from the error of the cubic through both ends of [a, b] at c beyond b.
double fourth_derivative(const Node& a, const Node& b, const Node& c) {
  const double H = b.u - a.u, h = c.u - b.u, t = 1 + h / H;
  const double h00 = (1 + 2 * t) * (1 - t) * (1 - t), h10 = t * (1 - t) * (1 - t), h01 = t * t * (3 - 2 * t),
               h11 = t * t * (t - 1);
  const double cubic =
      h00 * a.log_d() + h10 * H * a.log_d_slope() + h01 * b.log_d() + h11 * H * b.log_d_slope();
  return 24 * std::abs(c.log_d() - cubic) / (h * h * (h + H) * (h + H));
}

class BranchSampler {
 public:
  BranchSampler(const TableSpec& spec, double radius_um, const std::atomic<bool>* stop)
      : spec_(spec), radius_(radius_um) {
    newton_.stop = stop;
    newton_.tolerance = tolerance;
    result_.radius_um = radius_um;
    result_.bending_kBT = 0;
  }

  /// From the nearly undeformed sphere.
  SampledBranch from_sphere() {
    const auto start = std::chrono::steady_clock::now();
    if (enter()) follow();
    return finish(start);
  }

  /// From a state of the same cell with another bending stiffness, at the stiffness of one of its samples.
  SampledBranch from_bare(BranchSampler& bare, double stiffness) {
    const auto start = std::chrono::steady_clock::now();
    result_.bending_kBT = spec_.base.cell.cortex.bending_kBT;
    if (bare.enter() && bare.reach(stiffness) && change_bending(bare, stiffness)) follow();
    return finish(start);
  }

 private:
  double stiffness(double u) const { return first_stiffness_ * std::exp(-u); }
  Problem problem(double u) const { return problem_of(case_at(spec_, radius_, stiffness(u))); }
  StationarySystem& system() { return discrete_->system; }
  const Discretisation& space() const { return discrete_->space; }

  Path path(double end) {
    return {[this](double) -> StationarySystem& { return discrete_->system; },
            [this](double u) { return media_at(problem(u), 1); }, end, -std::numeric_limits<double>::infinity()};
  }

  ContinuationOptions options() {
    ContinuationOptions options;
    options.newton = newton_;
    options.newton.iteration_limit = 6;
    options.least_step = least_step;
    options.accept = [this](const Discretisation& where, const BranchState& state) {
      const bool accepted = !is_wrinkled(problem(state.parameter), where, state.unknowns);
      result_.refused += !accepted;
      return accepted;
    };
    return options;
  }

  /// The first state: stiffness and state of a cell that is less deformed than the table's least deformation.
  bool enter() {
    use_level(first_level, problem(0));
    for (int attempt = 0; attempt < 30; ++attempt) {
      ContinuationOptions start = options();
      start.accept = {};
      start.displacement_per_step = first_displacement;
      const Problem here = problem(0);
      const ContinuationReport report = start_branch(system(), here, start);
      count(report.newton_iterations);
      if (report.status != Status::converged) return end(report.status), false;
      const double d = deformation(report.last.unknowns);
      if (report.last.parameter == 1 && d <= spec_.least_deformation) {
        last_ = {0, report.last.unknowns, {}, {}, {}, {}, 0};
        return true;
      }
      // The deformation goes with the square of the compliance.
      first_stiffness_ *= report.last.parameter < 1 ? 1.01 / report.last.parameter
                                                    : 1.05 * std::sqrt(d / spec_.least_deformation);
    }
    return end(Status::iteration_limit), false;
  }

  void use_level(int level, const Problem& at) {
    level_ = level;
    discrete_ = make(level, at);
    coarse_ = make(level - 1, at);
  }
  std::shared_ptr<Discrete> make(int level, const Problem& at) const {
    return std::make_shared<Discrete>(at, ladder[level]);
  }

  /// Samples the branch from the present state on.
  void follow() {
    if (!sample(last_)) return;
    nodes_.push_back(last_);
    double h = first_step;
    while (true) {
      const Node before = nodes_.back();
      Node next;
      const Status status = advance(before, before.u + h, next);
      const bool moved = next.u > before.u + least_step / 4;
      if (status == Status::stopped) return end(status);
      if (moved && sample(next)) nodes_.push_back(next);
      const bool accepted = nodes_.back().u > before.u;
      if (accepted && status == Status::converged) {
        if (nodes_.back().state.value(0) > spec_.greatest_deformation) return end("covered", "");
        h = refine_last_interval();
        continue;
      }
      if (!accepted && moved) return end(Status::accuracy_not_reached);
      // At the limit of stability of its surface the branch ends on every mesh.
      const bool unstable = margin(nodes_.back()) < small_margin;
      if (unstable || !finer(nodes_.back())) return end(unstable ? Status::surface_unstable : status);
    }
  }

  /// Goes to `u` as far as the branch goes.
  Status advance(const Node& from, double u, Node& next) {
    const ContinuationReport report =
        continue_branch(path(u), options(), {from.u, from.unknowns, from.tangent, 0});
    count(report.newton_iterations);
    next.u = report.last.parameter;
    next.unknowns = report.last.unknowns;
    return report.status;
  }

  /// Goes to a stiffness without samples.
  bool reach(double wanted) {
    BranchState state{last_.u, last_.unknowns, {}, 0};
    const auto report = continue_branch(path(std::log(first_stiffness_ / wanted)), options(), state);
    count(report.newton_iterations);
    last_ = {report.last.parameter, report.last.unknowns, {}, {}, {}, {}, 0};
    return report.status == Status::converged;
  }

  /// From the bare cell's state to the one with bending stiffness, which becomes the first state here.
  bool change_bending(BranchSampler& bare, double at) {
    first_stiffness_ = at;
    discrete_ = bare.discrete_;
    coarse_ = bare.coarse_;
    level_ = bare.level_;
    const Problem from = bare.problem(bare.last_.u), to = problem(0);
    const Path bend = {[this](double) -> StationarySystem& { return discrete_->system; },
                       [from, to](double s) { return media_at(between(from, to, s), 1); }, 1,
                       -std::numeric_limits<double>::infinity()};
    ContinuationOptions free = options();
    free.accept = {};
    const auto report = continue_branch(bend, free, {0, bare.last_.unknowns, {}, 0});
    count(report.newton_iterations);
    last_ = {0, report.last.unknowns, {}, {}, {}, {}, 0};
    return report.status == Status::converged || (end(report.status), false);
  }

  /// Measures a converged state with its slopes and its error, on finer meshes if need be; false if it is not accurate.
  bool sample(Node& node) {
    while (true) {
      double det = 0;
      bool factorised = false;
      const Problem here = problem(node.u);
      system().linearise(media_at(here, 1), node.unknowns, det, factorised);
      if (!factorised) return false;
      node.tangent = branch_tangent(path(node.u), {node.u, node.unknowns, {}, 0});
      node.state = measure_state(space(), here, scales(), node.unknowns);
      node.error = error_of(node);
      if (node.error <= spec_.accuracy) break;
      if (!finer(node)) return ++result_.refused, false;
    }
    const double h = 1e-4;
    const auto moved = [&](double step) {
      return measure_state(space(), problem(node.u + step), scales(), node.unknowns + step * node.tangent);
    };
    const MeasuredState plus = moved(h), minus = moved(-h);
    node.slope = (plus.value - minus.value) / (2 * h);
    node.contour_slope = (plus.contour - minus.contour) / (2 * h);
    return true;
  }

  double error_of(const Node& node) {
    VectorXd unknowns = transfer(space(), node.unknowns, coarse_->space);
    NewtonOptions newton_options = newton_;
    newton_options.tolerance = 1e-8;
    const NewtonReport report =
        newton(coarse_->system, media_at(problem(node.u), 1), newton_options, unknowns);
    count(report.iterations);
    if (report.status != Status::converged) return std::numeric_limits<double>::infinity();
    const double coarse = measure(contour(coarse_->space, unknowns)).deformation;
    return share_of_change * std::abs(coarse / node.state.value(0) - 1);
  }

  /// Carries a state to the next level; false if there is none or the state does not hold there.
  bool finer(Node& node) {
    if (level_ + 1 >= int(ladder.size())) return false;
    const auto next = make(level_ + 1, problem(node.u));
    VectorXd unknowns = transfer(space(), node.unknowns, next->space);
    const NewtonReport report = newton(next->system, media_at(problem(node.u), 1), newton_, unknowns);
    count(report.iterations);
    if (report.status != Status::converged || is_wrinkled(problem(node.u), next->space, unknowns)) return false;
    result_.factorisation_seconds += work();
    coarse_ = discrete_;
    discrete_ = next;
    ++level_;
    node.unknowns = unknowns;
    node.tangent = {};
    return true;
  }

  /// Halves the last interval while the interpolation in it is not accurate; returns the next step.
  double refine_last_interval() {
    const double wanted = share_of_interpolation * spec_.accuracy;
    const std::size_t n = nodes_.size();
    double h = nodes_[n - 1].u - nodes_[n - 2].u;
    if (n < 3) return h;
    const double f4 = std::max(fourth_derivative(nodes_[n - 3], nodes_[n - 2], nodes_[n - 1]), 1e-12);
    const double allowed = std::pow(384 * wanted / f4, 0.25);
    if (h > 1.3 * allowed) insert_middle();
    return std::clamp(0.9 * allowed, 0.25 * h, std::min(2 * h, greatest_step));
  }

  /// One more sample in the middle of the last interval.
  void insert_middle() {
    const Node& a = nodes_[nodes_.size() - 2];
    Node middle;
    const double u = (a.u + nodes_.back().u) / 2;
    Node from = a;
    if (from.unknowns.size() != space().unknowns()) return;  // the level has changed between the two
    if (advance(from, u, middle) == Status::converged && sample(middle)) nodes_.insert(nodes_.end() - 1, middle);
  }

  double margin(const Node& node) const { return node.state.value(int(Measure::stability_margin)); }
  double deformation(const VectorXd& unknowns) const { return measure(contour(space(), unknowns)).deformation; }
  Scales scales() const { return scales_of(case_at(spec_, radius_, first_stiffness_)); }
  void count(int iterations) {
    ++result_.solves;
    result_.newton_iterations += iterations;
  }
  double work() const {
    double seconds = 0;
    for (const auto& system : {discrete_, coarse_}) {
      if (system) seconds += system->system.work().condensation_s + system->system.work().sparse_s;
    }
    return seconds;
  }

  void end(Status status) { end(name(status), explanation({status, "", 1}, {0, 0, SurfaceKind::bare})); }
  void end(const std::string& status, const std::string& message) { result_.end = {status, message}; }

  SampledBranch finish(std::chrono::steady_clock::time_point start) {
    const int n = int(nodes_.size());
    result_.value.resize(n, measure_count);
    result_.slope.resize(n, measure_count);
    for (int i = 0; i < n; ++i) {
      const Node& node = nodes_[i];
      result_.stiffness.push_back(stiffness(node.u));
      result_.value.row(i) = node.state.value.transpose();
      result_.slope.row(i) = -node.slope.transpose();
      result_.error.push_back(node.error);
      result_.contour.push_back(node.state.contour);
      result_.contour_slope.push_back(-node.contour_slope);
    }
    result_.factorisation_seconds += work();
    result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return std::move(result_);
  }

  TableSpec spec_;
  double radius_, first_stiffness_ = 1;
  NewtonOptions newton_;
  int level_ = first_level;
  std::shared_ptr<Discrete> discrete_, coarse_;
  Node last_;
  std::vector<Node> nodes_;
  SampledBranch result_;
};

}  // namespace

SampledBranch sample_branch(const TableSpec& spec, double radius_um, const std::atomic<bool>* stop) {
  return BranchSampler(spec, radius_um, stop).from_sphere();
}

SampledBranch sample_held_branch(const TableSpec& spec, const SampledBranch& own, const std::atomic<bool>* stop) {
  constexpr double overlap = 1.25;  // of the stiffness
  const bool ended_by_surface = own.end.status == name(Status::surface_unstable);
  if (spec.bending_beyond_kBT <= 0 || own.empty() || !ended_by_surface) return {};
  TableSpec held = spec;
  held.base.cell.cortex.bending_kBT = spec.bending_beyond_kBT;
  const double stiffness = std::min(overlap * own.stiffness.back(), own.stiffness.front());
  BranchSampler bare(spec, own.radius_um, stop);
  return BranchSampler(held, own.radius_um, stop).from_bare(bare, stiffness);
}

}  // namespace rheocyte
