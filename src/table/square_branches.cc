#include "table/square_branches.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "case/channel_flow.h"
#include "case/scales.h"
#include "case/user_error.h"
#include "numeric/dense_solve.h"
#include "numeric/lagrange.h"
#include "shape/outline_shape.h"

namespace rheocyte {
namespace {

constexpr std::ptrdiff_t fewest_radii = 4;
/// Samples of a branch in equal ratios of sqrt(d); cubics between them are good to 1e-6.
constexpr int dense_samples = 48;
/// How far polynomials may go on beyond the last state of a branch, in sqrt(d).
constexpr double max_continuation = 0.04;
/// Of the miss of polynomials that leave a node out: between nodes that they have, they miss a tenth.
constexpr double fraction_of_miss = 0.1;
constexpr double max_exponent_difference = 0.01;

double sqrt_deformation(const SampledBranch& branch, int sample) {
  return std::sqrt(branch.at(sample, Measure::deformation));
}

/// A measure as q in value = base + s^power q with s = sqrt(d): q is smooth and has no zero at s = 0.
struct Scaling {
  double base = 0;
  int power = 0;
};

Scaling scaling_of(int measure) {
  const std::string_view name = table_measures[std::size_t(measure)].name;
  if (name.starts_with("deformation")) return {0, 2};
  if (name.starts_with("moment_ratio") || name == "inertia_ratio") return {1, 2};
  if (name.starts_with("mode_")) return {0, order_of_mode(name[5] - '0')};
  return {};
}

/// ln(E) as a function of r0 and ln(d) that takes most of its changes away: the tube's table at the area of the sphere,
/// continued in straight lines beyond its rims, or -ln(d) / 2. At the cell's own area, which grows with d, large cells
/// would cross the rim on their way.
class ReferenceStiffness {
 public:
  ReferenceStiffness(const TableSpec& spec, const GridContent* tube) {
    if (!tube) return;
    const ChannelFlow flow = channel_flow_of(spec.base);
    if (std::abs(flow.exponent - tube->origin.flow.exponent) > max_exponent_difference ||
        tube->origin.section != Section::tube || tube->origin.is_shell)
      throw UserError(
          fmt::format("table.tube_table = {}: is not a table of solids in the tube in a liquid of exponent {:.4g}, "
                      "as the spec is for; name another one, or leave it out.",
                      tube->origin.identifier, flow.exponent));
    const ScaleFactors factors = scale_factors(tube->origin.flow, flow);
    log_area_factor_ = std::log(factors.area);
    log_modulus_factor_ = std::log(factors.modulus);
    grid_.emplace(*tube);
  }

  struct Value {
    double log_stiffness, by_log_deformation;
  };
  Value operator()(double radius_um, double log_deformation) const {
    if (!grid_) return {-log_deformation / 2, -0.5};
    constexpr double rim = 1e-6;
    const GridContent& content = grid_->content();
    const double first = content.min_log_area, last = first + content.column_step * (content.columns - 1);
    const double log_area = std::log(std::numbers::pi * radius_um * radius_um) - log_area_factor_;
    const double x = std::clamp(log_area, first + rim, last - rim);
    const auto range = *grid_->smooth_range(std::exp(x));
    const double y = std::clamp(log_deformation, range.lower + rim, range.upper - rim);
    const GridAnswer at = grid_->answer(std::exp(x), std::exp(y));
    const double beyond = (log_area - x) * at.by_log_area + (log_deformation - y) * at.by_log_deformation;
    return {log_modulus_factor_ + at.log_stiffness + beyond, at.by_log_deformation};
  }

 private:
  std::optional<StiffnessGrid> grid_;
  double log_area_factor_ = 0, log_modulus_factor_ = 0;
};

/// The polynomials along one computed branch over s = sqrt(d).
class Curve {
 public:
  Curve(const SampledBranch& branch, const ReferenceStiffness& reference) : branch_(&branch) {
    const int samples = branch.samples();
    s_ = roots_of_deformation(branch);
    numbers_.resize(samples, measure_count + 1);
    for (int k = 0; k < samples; ++k) {
      const double s = s_[std::size_t(k)];
      for (int m = 0; m < measure_count; ++m) {
        const Scaling scaling = scaling_of(m);
        numbers_(k, m) = (branch.value(k, m) - scaling.base) / std::pow(s, scaling.power);
      }
      numbers_(k, measure_count) =
          std::log(branch.stiffness[std::size_t(k)]) - reference(branch.radius_um, 2 * std::log(s)).log_stiffness;
    }
  }

  const SampledBranch& branch() const { return *branch_; }
  double last() const { return s_.back(); }
  const std::vector<double>& s() const { return s_; }

  /// Measures as `Scaling` has them, and ln(E) less that of the reference.
  Eigen::VectorXd numbers(const std::vector<double>& weights) const {
    return numbers_.transpose() * Eigen::Map<const Eigen::VectorXd>(weights.data(), std::ssize(weights));
  }
  Eigen::MatrixX2d contour(const std::vector<double>& weights) const {
    Eigen::MatrixX2d sum = weights[0] * branch_->contour[0];
    for (std::size_t k = 1; k < weights.size(); ++k) sum += weights[k] * branch_->contour[k];
    return sum;
  }
  /// Relative, of the deformation: what the polynomial makes of the independent errors of the states.
  double error(double s) const {
    const auto weights = lagrange_weights(s_, std::clamp(s, s_.front(), s_.back())).value;
    double squares = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) squares += std::pow(weights[k] * branch_->error[k], 2);
    return std::sqrt(squares);
  }
  double log_ratio(int sample) const { return numbers_(sample, measure_count); }
  /// ln(E) over the reference at a sample by the others.
  double log_ratio_without(int sample) const {
    std::vector<double> nodes, values;
    for (int k = 0; k < branch_->samples(); ++k) {
      if (k == sample) continue;
      nodes.push_back(s_[std::size_t(k)]);
      values.push_back(log_ratio(k));
    }
    const auto weights = lagrange_weights(nodes, s_[std::size_t(sample)]).value;
    double sum = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] * values[k];
    return sum;
  }

 private:
  const SampledBranch* branch_;
  std::vector<double> s_;
  Eigen::MatrixXd numbers_;  ///< samples x (measures, ln of the ratio)
};

bool has_curve(const SampledBranch& branch) { return branch.samples() > 2; }

/// One state between the computed ones.
struct DenseState {
  double stiffness = 0;
  Eigen::VectorXd value, slope;
  Eigen::MatrixX2d contour, contour_slope;
};

/// A radius between the computed ones: their weights, and the length of its branch in sqrt(d).
struct Radius {
  double um;
  std::vector<double> weights;
  double length = 0;
};

class Surface {
 public:
  Surface(const TableSpec& spec, std::span<const SampledBranch> computed, const GridContent* tube)
      : reference_(spec, tube), half_width_um_(unit_length_um(spec.base)) {
    for (const auto& branch : computed)
      if (has_curve(branch)) curves_.emplace_back(branch, reference_);
    if (!can_lie_between(computed))
      throw UserError(
          fmt::format("only {} of {} computed branches have states; a table needs {}. Choose smaller cells or "
                      "a lower table.max_deformation.",
                      curves_.size(), computed.size(), fewest_radii));
    set_ends();
  }

  const std::vector<Curve>& curves() const { return curves_; }

  /// Polynomials do not go on beyond the computed radii.
  bool reaches(double radius_um) const {
    constexpr double rounding = 1e-9;
    return radius_um > curves_.front().branch().radius_um * (1 - rounding) &&
           radius_um < curves_.back().branch().radius_um * (1 + rounding);
  }

  Radius at(double radius_um) const {
    Radius radius{radius_um, across(radius_um)};
    radius.length = std::inner_product(radius.weights.begin(), radius.weights.end(), ends_.begin(), 0.0);
    return radius;
  }

  /// sqrt(d) of the last state of a radius: on the straight line between those of the computed neighbours, as far as no
  /// branch goes on too far beyond its states.
  double last(const Radius& radius) const {
    std::size_t right = 1;
    while (right + 1 < curves_.size() && curves_[right].branch().radius_um < radius.um) ++right;
    const Curve &a = curves_[right - 1], &b = curves_[right];
    const double fraction = (radius.um - a.branch().radius_um) / (b.branch().radius_um - a.branch().radius_um);
    return std::min(a.last() + fraction * (b.last() - a.last()), reach_ * radius.length);
  }

  DenseState state(const Radius& radius, double s) const {
    Eigen::VectorXd q = Eigen::VectorXd::Zero(measure_count + 1), by_s = q;
    const Eigen::Index points = curves_.front().branch().contour.front().rows();
    DenseState state;
    state.contour = state.contour_slope = Eigen::MatrixX2d::Zero(points, 2);
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      const double weight = radius.weights[i], length = ends_[i] / radius.length;
      const auto along = lagrange_weights(curves_[i].s(), length * s);
      q += weight * curves_[i].numbers(along.value);
      by_s += weight * length * curves_[i].numbers(along.slope);
      state.contour += weight * curves_[i].contour(along.value);
      state.contour_slope += weight * length * curves_[i].contour(along.slope);
    }
    finish(radius.um, s, q, by_s, state);
    return state;
  }

  /// ln(E) over the reference at a place on a branch by the branches of all other radii.
  double log_ratio_without(std::size_t left_out, double s) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      if (i == left_out) continue;
      const auto along = lagrange_weights(curves_[i].s(), ends_[i] / ends_[left_out] * s);
      values.push_back(curves_[i].numbers(along.value)(measure_count));
    }
    const auto weights = across(curves_[left_out].branch().radius_um, std::ptrdiff_t(left_out));
    double sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * values[i];
    return sum;
  }

 private:
  /// Branches are compared at equal fractions of their length, which must not change abruptly from one radius to the
  /// next: a last state lies where a cell happens to be accurate, so lengths are those of a parabola through all of
  /// them.
  void set_ends() {
    const auto count = std::ssize(curves_);
    Eigen::MatrixX3d powers(count, 3);
    Eigen::VectorXd last(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Curve& curve = curves_[std::size_t(i)];
      const double x = curve.branch().radius_um / curves_.back().branch().radius_um;
      powers.row(i) << 1, x, x * x;
      last(i) = curve.last();
    }
    const Eigen::VectorXd smooth = powers * least_squares(powers, last);
    ends_.assign(smooth.begin(), smooth.end());
    reach_ = (1 + max_continuation) * (last.array() / smooth.array()).minCoeff();
  }

  double coordinate(double radius_um) const { return radius_coordinate(radius_um / half_width_um_); }

  std::vector<double> across(double radius_um, std::ptrdiff_t left_out = -1) const {
    std::vector<double> at;
    for (std::ptrdiff_t i = 0; i < std::ssize(curves_); ++i)
      if (i != left_out) at.push_back(coordinate(curves_[std::size_t(i)].branch().radius_um));
    return lagrange_weights(at, coordinate(radius_um)).value;
  }

  /// From scaled numbers and their derivatives with s to values and derivatives with ln(E).
  void finish(double radius_um, double s, const Eigen::VectorXd& q, const Eigen::VectorXd& by_s,
              DenseState& state) const {
    state.value.resize(measure_count);
    state.slope.resize(measure_count);
    for (int m = 0; m < measure_count; ++m) {
      const auto [base, power] = scaling_of(m);
      const double factor = std::pow(s, power);
      state.value(m) = base + factor * q(m);
      state.slope(m) = factor * (power / s * q(m) + by_s(m));
    }
    const auto reference = reference_(radius_um, 2 * std::log(s));
    state.stiffness = std::exp(reference.log_stiffness + q(measure_count));
    const double by_log_stiffness = 1 / (by_s(measure_count) + reference.by_log_deformation * 2 / s);
    state.slope *= by_log_stiffness;
    state.contour_slope *= by_log_stiffness;
  }

  ReferenceStiffness reference_;
  double half_width_um_;
  std::vector<Curve> curves_;
  std::vector<double> ends_;  ///< sqrt(d), one for each curve
  double reach_ = 1;          ///< so many lengths are within the states of all curves, or little beyond
};

LeftOut left_out(const Surface& surface) {
  LeftOut miss;
  const auto& curves = surface.curves();
  for (std::size_t i = 1; i + 1 < curves.size(); ++i)
    for (int k = 0; k < curves[i].branch().samples(); ++k)
      miss.radius = std::max(
          miss.radius, std::abs(surface.log_ratio_without(i, curves[i].s()[std::size_t(k)]) - curves[i].log_ratio(k)));
  for (const Curve& curve : curves)
    for (int k = 1; k + 1 < curve.branch().samples(); ++k)
      miss.state = std::max(miss.state, std::abs(curve.log_ratio_without(k) - curve.log_ratio(k)));
  return miss;
}

const Curve& nearest(const std::vector<Curve>& curves, double radius_um) {
  return *std::ranges::min_element(curves, {},
                                   [&](const Curve& curve) { return std::abs(curve.branch().radius_um - radius_um); });
}

SampledBranch dense_branch(const TableSpec& spec, const Surface& surface, double radius_um, double miss) {
  const Curve& curve = nearest(surface.curves(), radius_um);
  const SampledBranch& near = curve.branch();
  SampledBranch branch;
  branch.radius_um = radius_um;
  branch.end = near.end;
  branch.bending_kBT = near.bending_kBT;
  branch.value.resize(dense_samples, measure_count);
  branch.slope.resize(dense_samples, measure_count);
  const Radius radius = surface.at(radius_um);
  const double last = surface.last(radius), first = 0.98 * std::sqrt(spec.min_deformation) / last;
  for (int k = 0; k < dense_samples; ++k) {
    const double fraction = std::pow(first, 1 - double(k) / (dense_samples - 1));
    DenseState state = surface.state(radius, last * fraction);
    branch.value.row(k) = state.value.transpose();
    branch.slope.row(k) = state.slope.transpose();
    branch.stiffness.push_back(state.stiffness);
    branch.contour.push_back(std::move(state.contour));
    branch.contour_slope.push_back(std::move(state.contour_slope));
    const double response = std::abs(branch.slope(k, 0) / branch.value(k, 0));  // d ln(d) / d ln(E)
    branch.error.push_back(curve.error(fraction * curve.last()) + miss * response);
  }
  return branch;
}

}  // namespace

std::vector<double> roots_of_deformation(const SampledBranch& branch) {
  std::vector<double> roots;
  for (int k = 0; k < branch.samples(); ++k) roots.push_back(sqrt_deformation(branch, k));
  return roots;
}

void set_slopes(SampledBranch& branch, const std::vector<double>& s) {
  const int n = branch.samples();
  branch.slope = Eigen::MatrixXd::Zero(n, measure_count);
  branch.contour_slope.assign(std::size_t(n), {});
  for (int k = 0; k < n; ++k) {
    const auto weights = lagrange_weights(s, s[std::size_t(k)]).slope;
    double of_log_stiffness = -1 / s[std::size_t(k)];
    auto& contour = branch.contour_slope[std::size_t(k)] = Eigen::MatrixX2d::Zero(branch.contour.front().rows(), 2);
    for (std::size_t j = 0; j < weights.size(); ++j) {
      of_log_stiffness += weights[j] * std::log(branch.stiffness[j] * s[j]);
      branch.slope.row(k) += weights[j] * branch.value.row(Eigen::Index(j));
      contour += weights[j] * branch.contour[j];
    }
    branch.slope.row(k) /= of_log_stiffness;
    contour /= of_log_stiffness;
  }
}

bool can_lie_between(std::span<const SampledBranch> computed) {
  return std::ranges::count_if(computed, has_curve) >= fewest_radii;
}

std::vector<SampledBranch> square_branches(const TableSpec& spec, std::span<const SampledBranch> computed,
                                           const GridContent* tube) {
  const Surface surface(spec, computed, tube);
  const LeftOut miss = left_out(surface);
  std::vector<SampledBranch> branches;
  for (const double radius : sweep_radii_um(spec))
    if (surface.reaches(radius))
      branches.push_back(dense_branch(spec, surface, radius, fraction_of_miss * std::max(miss.radius, miss.state)));
  return branches;
}

LeftOut left_out(const TableSpec& spec, std::span<const SampledBranch> computed, const GridContent* tube) {
  return left_out(Surface(spec, computed, tube));
}

}  // namespace rheocyte
