#include "table/square_branches.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "case/scales.h"
#include "case/user_error.h"
#include "numeric/dense_solve.h"
#include "numeric/lagrange.h"
#include "table/branch_curve.h"
#include "table/reference_stiffness.h"

namespace rheocyte {
namespace {

constexpr std::ptrdiff_t fewest_radii = 4;
/// Samples of a branch in equal ratios of sqrt(d); cubics between them are good to 1e-6.
constexpr int dense_samples = 48;
/// How far polynomials may go on beyond the last state of a branch, in sqrt(d).
constexpr double max_continuation = 0.04;
/// Of the miss of polynomials that leave a node out: between nodes that they have, they miss a tenth.
constexpr double fraction_of_miss = 0.1;

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

  const std::vector<BranchCurve>& curves() const { return curves_; }

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
    const BranchCurve &a = curves_[right - 1], &b = curves_[right];
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
    return std::inner_product(weights.begin(), weights.end(), values.begin(), 0.0);
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
      const BranchCurve& curve = curves_[std::size_t(i)];
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
  std::vector<BranchCurve> curves_;
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
  for (const BranchCurve& curve : curves)
    for (int k = 1; k + 1 < curve.branch().samples(); ++k)
      miss.state = std::max(miss.state, std::abs(curve.log_ratio_without(k) - curve.log_ratio(k)));
  return miss;
}

const BranchCurve& nearest(const std::vector<BranchCurve>& curves, double radius_um) {
  return *std::ranges::min_element(
      curves, {}, [&](const BranchCurve& curve) { return std::abs(curve.branch().radius_um - radius_um); });
}

SampledBranch dense_branch(const TableSpec& spec, const Surface& surface, double radius_um, double miss) {
  const BranchCurve& curve = nearest(surface.curves(), radius_um);
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
