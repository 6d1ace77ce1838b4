#include "table/sample_branch.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "case/scales.h"
#include "shape/measures.h"
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
constexpr double first_step = 0.25, first_held_step = 0.08, greatest_step = 0.9, least_step = 2e-3;
/// So many states in a row may fail to be accurate before a branch is given up; each is nearer than the one before.
constexpr int greatest_unsampled = 4;
/// Of the step that the last interval would have allowed: towards its end a branch needs ever smaller ones.
constexpr double growth = 0.6;
/// A branch that is steeper than this (-d ln d / d ln E) nears a fold: finer meshes would not go farther.
constexpr double steep = 4;
/// Change of ln d between two samples against the trapezoidal rule of its slopes.
constexpr double greatest_mismatch = 0.15;
/// Between two samples the error of the interpolation may be this share of the accuracy.
constexpr double share_of_interpolation = 0.25;

/// A state at u = ln(first stiffness / stiffness).
struct Node {
  double u = 0;
  int level = 0;               ///< of the ladder
  VectorXd unknowns, tangent;  ///< d/du
  MeasuredState state;
  Eigen::VectorXd slope;  ///< d(value)/du
  Eigen::MatrixX2d contour_slope;
  double error = 0;
  double log_d() const { return std::log(state.value(0)); }
  double log_d_slope() const { return slope(0) / state.value(0); }
};

std::string reason(Status status) {
  switch (status) {
    case Status::surface_unstable: return "the surface loses stability against short wrinkles";
    case Status::branch_ended: return "the branch turns back: softer cells are drawn out without limit";
    case Status::accuracy_not_reached: return "the next state is not within the accuracy on the finest mesh";
    case Status::mesh_folded: return "the mesh of the liquid folds";
    case Status::stopped: return "stopped by a signal";
    default: return std::string("Newton's method ended: ") + name(status);
  }
}

/// f4 of a function from the error of the cubic through both ends of [a, b] at c beyond b.
double fourth_derivative(const Node& a, const Node& b, const Node& c) {
  const double H = b.u - a.u, h = c.u - b.u, t = 1 + h / H;
  const double h00 = (1 + 2 * t) * (1 - t) * (1 - t), h10 = t * (1 - t) * (1 - t), h01 = t * t * (3 - 2 * t),
               h11 = t * t * (t - 1);
  const double cubic = h00 * a.log_d() + h10 * H * a.log_d_slope() + h01 * b.log_d() + h11 * H * b.log_d_slope();
  return 24 * std::abs(c.log_d() - cubic) / (h * h * (h + H) * (h + H));
}

class BranchSampler {
 public:
  BranchSampler(const TableSpec& spec, const BranchPlace& place, const std::atomic<bool>* stop)
      : spec_(spec), place_(place) {
    newton_.stop = stop;
    newton_.tolerance = tolerance;
    result_.radius_um = place.radius_um;
    result_.cortex_share = place.cortex_share;
    result_.tension_ratio = place.tension_ratio;
  }

  /// From the nearly undeformed sphere.
  SampledBranch from_sphere() {
    const auto start = std::chrono::steady_clock::now();
    if (enter()) follow();
    return finish(start);
  }

  /// From a stiffness on; the way there from the nearly undeformed sphere is not sampled.
  SampledBranch from_stiffness(double stiffness) {
    const auto start = std::chrono::steady_clock::now();
    result_.bending_kBT = spec_.base.cell.cortex.bending_kBT;
    if (enter() && reach(stiffness)) follow();
    return finish(start);
  }

 private:
  double stiffness(double u) const { return first_stiffness_ * std::exp(-u); }
  Problem problem(double u) const { return problem_of(case_at(spec_, place_, stiffness(u))); }

  Discrete& at_level(int level) {
    if (!discrete_[level]) discrete_[level] = std::make_shared<Discrete>(problem(0), ladder[level]);
    return *discrete_[level];
  }

  Path path(int level, double end) {
    return {[this, level](double) -> NonlinearSystem& { return at_level(level).system; },
            [this](double u) { return media_at(problem(u), 1); }, end, -std::numeric_limits<double>::infinity()};
  }

  ContinuationOptions options() {
    ContinuationOptions options;
    options.newton = newton_;
    options.newton.iteration_limit = 5;
    options.least_step = least_step;
    options.accept = [this](const NonlinearSystem& system, const BranchState& state) {
      const bool accepted = !is_wrinkled(problem(state.parameter), space_of(system), state.unknowns);
      result_.refused += !accepted;
      return accepted;
    };
    return options;
  }

  /// The first state: stiffness and state of a cell that is less deformed than the table's least deformation.
  bool enter() {
    Discrete& discrete = at_level(first_level);
    for (int attempt = 0; attempt < 30; ++attempt) {
      ContinuationOptions start = options();
      start.accept = {};
      start.displacement_per_step = first_displacement;
      const ContinuationReport report = start_branch(discrete.system, problem(0), start);
      count(report.newton_iterations);
      if (report.status != Status::converged) return end(report.status), false;
      const double d = deformation(discrete.space, report.last.unknowns);
      if (report.last.parameter == 1 && d <= spec_.least_deformation) {
        last_ = at(0, first_level, report.last.unknowns);
        return true;
      }
      // The deformation goes with the square of the compliance.
      first_stiffness_ *=
          report.last.parameter < 1 ? 1.01 / report.last.parameter : 1.05 * std::sqrt(d / spec_.least_deformation);
    }
    return end(Status::iteration_limit), false;
  }

  static Node at(double u, int level, VectorXd unknowns) {
    Node node;
    node.u = u;
    node.level = level;
    node.unknowns = std::move(unknowns);
    return node;
  }

  /// Samples the branch from the present state on. A sample behind which the interpolation would not be accurate is
  /// given up, and a nearer one taken; where the branch ends is looked for once.
  void follow() {
    if (!sample(last_)) return end(Status::accuracy_not_reached);
    nodes_.push_back(last_);
    std::optional<Node> last;  // the farthest state, once a step has failed
    Status failure = Status::not_started;
    int unsampled = 0;  // states in a row that were not accurate
    for (double h = result_.bending_kBT > 0 ? first_held_step : first_step; h > least_step / 2;) {
      const Node& before = nodes_.back();
      Node next;
      if (last && last->u - before.u < 1.2 * h) {
        next = *last;
      } else {
        const Status status = advance(before, before.u + h, next);
        if (status == Status::stopped) return end(status);
        const bool moved = next.u > before.u + least_step / 4;
        if (moved && !sample(next)) {
          // One state may fail where its neighbours do not.
          if (++unsampled > greatest_unsampled) return end(Status::accuracy_not_reached);
          h = 0.6 * (next.u - before.u);
          continue;
        }
        unsampled = 0;
        if (!moved) next = before;
        if (status != Status::converged) last = next, failure = status;
      }
      const double moved = next.u - before.u, allowed = moved > 0 ? allowed_step(before, next) : h;
      if (moved > 1.2 * allowed && 0.7 * allowed > least_step / 2) {
        h = 0.7 * allowed;
        continue;
      }
      if (moved > 0) nodes_.push_back(std::move(next)), release_coarse(nodes_.back().level);
      h = std::clamp(growth * allowed, 0.2 * moved, greatest_step);
      if (leaves_range(nodes_.back())) return;
      if (!last || nodes_.back().u < last->u) continue;
      if (margin(nodes_.back()) < small_margin) return end(Status::surface_unstable);
      if (nodes_.back().log_d_slope() > steep || !finer(nodes_.back())) return end(status_at_end(failure));
      last.reset();
      h = std::max(h, 4 * least_step);
    }
    end(Status::branch_ended);
  }

  /// Goes to `u` as far as the branch goes.
  Status advance(const Node& from, double u, Node& next) {
    const ContinuationReport report =
        continue_branch(path(from.level, u), options(), {from.u, from.unknowns, from.tangent, 0});
    count(report.newton_iterations);
    next = at(report.last.parameter, from.level, report.last.unknowns);
    return report.status;
  }

  /// Goes to a stiffness without samples.
  bool reach(double wanted) {
    const Node from = last_;
    const Status status = advance(from, std::log(first_stiffness_ / wanted), last_);
    if (status != Status::converged) end(status);
    return status == Status::converged;
  }

  /// Measures a converged state with its slopes and its error, on finer meshes if need be; false if it is not accurate.
  bool sample(Node& node) {
    while (true) {
      Discrete& discrete = at_level(node.level);
      double det = 0;
      bool factorised = false;
      const Problem here = problem(node.u);
      discrete.system.linearise(media_at(here, 1), node.unknowns, det, factorised);
      if (!factorised) return false;
      node.tangent = branch_tangent(path(node.level, node.u), {node.u, node.unknowns, {}, 0});
      node.state = measure_state(discrete.space, here, scales(), node.unknowns);
      node.error = error_of(node);
      if (node.error <= spec_.accuracy) break;
      if (!finer(node)) return ++result_.refused, false;
    }
    const double h = 1e-4;
    const auto moved = [&](double step) {
      return measure_state(at_level(node.level).space, problem(node.u + step), scales(),
                           node.unknowns + step * node.tangent);
    };
    const MeasuredState plus = moved(h), minus = moved(-h);
    node.slope = (plus.value - minus.value) / (2 * h);
    node.contour_slope = (plus.contour - minus.contour) / (2 * h);
    return true;
  }

  double error_of(const Node& node) {
    Discrete& coarse = at_level(node.level - 1);
    VectorXd unknowns = transfer(at_level(node.level).space, node.unknowns, coarse.space);
    NewtonOptions newton_options = newton_;
    newton_options.tolerance = 1e-8;
    const NewtonReport report = newton(coarse.system, media_at(problem(node.u), 1), newton_options, unknowns);
    count(report.iterations);
    if (report.status != Status::converged) return std::numeric_limits<double>::infinity();
    return share_of_change * std::abs(deformation(coarse.space, unknowns) / node.state.value(0) - 1);
  }

  /// Carries a state to the next level; false if there is none or the state does not hold there.
  bool finer(Node& node) {
    if (node.level + 1 >= int(ladder.size())) return false;
    Discrete& next = at_level(node.level + 1);
    VectorXd unknowns = transfer(at_level(node.level).space, node.unknowns, next.space);
    const NewtonReport report = newton(next.system, media_at(problem(node.u), 1), newton_, unknowns);
    count(report.iterations);
    if (report.status != Status::converged || is_wrinkled(problem(node.u), next.space, unknowns)) return false;
    ++node.level;
    node.unknowns = unknowns;
    node.tangent = {};
    return true;
  }

  /// The largest step behind which cubic interpolation is accurate, by the fourth derivative of ln d. Where the
  /// trapezoidal rule is far off, too: another branch was reached, or a fold is near.
  double allowed_step(const Node& before, const Node& next) {
    const double h = next.u - before.u, change = next.log_d() - before.log_d();
    const double trapezoid = h * (before.log_d_slope() + next.log_d_slope()) / 2;
    double allowed = greatest_step;
    if (std::abs(change - trapezoid) > greatest_mismatch * std::abs(change) + 1e-6) allowed = h / 2;
    const double wanted = share_of_interpolation * spec_.accuracy, off = middle_mismatch(before, next);
    if (off > wanted) allowed = std::min(allowed, h * std::max(0.4, std::cbrt(wanted / off)));
    if (nodes_.size() < 2) return allowed;
    const double f4 = std::max(fourth_derivative(nodes_[nodes_.size() - 2], before, next), 1e-12);
    return std::min(allowed, std::pow(384 * wanted / f4, 0.25));
  }

  /// The deformation of the interpolated contour against the interpolated deformation, relative, in the middle: the
  /// convex hull makes the deformation less smooth than the contour where a dent appears.
  double middle_mismatch(const Node& a, const Node& b) {
    const auto is_convex = [](const Node& node) {
      return node.state.value(int(Measure::deformation_raw)) <= node.state.value(0) * (1 + 1e-5);
    };
    if ((is_convex(a) && is_convex(b)) || a.level != b.level || a.tangent.size() == 0) return 0;
    const double h = b.u - a.u;
    const VectorXd middle = (a.unknowns + b.unknowns) / 2 + h / 8 * (a.tangent - b.tangent);
    const double log_d = (a.log_d() + b.log_d()) / 2 + h / 8 * (a.log_d_slope() - b.log_d_slope());
    return std::abs(std::log(deformation(at_level(a.level).space, middle)) - log_d);
  }

  bool leaves_range(const Node& node) {
    const auto at = [&](Measure m) { return node.state.value(int(m)); };
    const bool is_large = !spec_.is_combined() && at(Measure::area_um2) > 1.02 * spec_.greatest_area_um2;
    if (at(Measure::deformation) > spec_.greatest_deformation || is_large)
      return end("covered", "The branch leaves the table's ranges."), true;
    if (at(Measure::deformation_raw) > spec_.greatest_deformation_raw)
      return end("dented", "The dent at the rear is as deep as the table admits."), true;
    return false;
  }

  /// Newton's failure at the end of a branch is the end of the branch.
  static Status status_at_end(Status status) {
    return status == Status::iteration_limit || status == Status::converged ? Status::branch_ended : status;
  }

  double margin(const Node& node) const { return node.state.value(int(Measure::stability_margin)); }
  static double deformation(const Discretisation& space, const VectorXd& unknowns) {
    return measure(contour(space, unknowns)).deformation;
  }
  Scales scales() const { return scales_of(case_at(spec_, place_, first_stiffness_)); }
  void count(int iterations) {
    ++result_.solves;
    result_.newton_iterations += iterations;
  }
  /// A state needs its own level and the one before, which tells its error; factors take some 100 MB on the others.
  void release_coarse(int level) {
    for (int i = 0; i < level - 1; ++i) {
      if (discrete_[i]) released_factorisation_ += factorisation_seconds(*discrete_[i]);
      discrete_[i].reset();
    }
  }
  static double factorisation_seconds(const Discrete& discrete) {
    return discrete.system.work().condensation_s + discrete.system.work().sparse_s;
  }
  double factorisation_seconds() const {
    double seconds = released_factorisation_;
    for (const auto& discrete : discrete_)
      if (discrete) seconds += factorisation_seconds(*discrete);
    return seconds;
  }

  void end(Status status) { end(name(status), reason(status)); }
  void end(const std::string& status, const std::string& message) { result_.end = {status, message}; }

  SampledBranch finish(std::chrono::steady_clock::time_point start) {
    // A stop looks like a failure to whatever it interrupts.
    if (newton_.stop && *newton_.stop) end(name(Status::stopped), reason(Status::stopped));
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
    result_.factorisation_seconds = factorisation_seconds();
    result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return std::move(result_);
  }

  TableSpec spec_;
  BranchPlace place_;
  double first_stiffness_ = 1;
  NewtonOptions newton_;
  std::array<std::shared_ptr<Discrete>, ladder.size()> discrete_;
  double released_factorisation_ = 0;
  Node last_;
  std::vector<Node> nodes_;
  SampledBranch result_;
};

}  // namespace

SampledBranch sample_branch(const TableSpec& spec, const BranchPlace& place, const std::atomic<bool>* stop) {
  return BranchSampler(spec, place, stop).from_sphere();
}

bool can_be_held(const TableSpec& spec, const SampledBranch& own) {
  return spec.bending_beyond_kBT > 0 && !own.empty() && own.end.status == name(Status::surface_unstable);
}

SampledBranch sample_held_branch(const TableSpec& spec, const SampledBranch& own, const std::atomic<bool>* stop) {
  constexpr double overlap = 1.25;  // of the stiffness
  if (!can_be_held(spec, own)) return {};
  TableSpec held = spec;
  held.base.cell.cortex.bending_kBT = spec.bending_beyond_kBT;
  const double stiffness = std::min(overlap * own.stiffness.back(), own.stiffness.front());
  const BranchPlace place{own.radius_um, own.cortex_share, own.tension_ratio};
  return BranchSampler(held, place, stop).from_stiffness(stiffness);
}

}  // namespace rheocyte
