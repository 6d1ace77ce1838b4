#include "table/branch_curve.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

#include "numeric/lagrange.h"
#include "shape/outline_shape.h"

namespace rheocyte {

std::vector<double> roots_of_deformation(const SampledBranch& branch) {
  std::vector<double> roots;
  for (int k = 0; k < branch.samples(); ++k) roots.push_back(std::sqrt(branch.at(k, Measure::deformation)));
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

Scaling scaling_of(int measure) {
  const std::string_view name = table_measures[std::size_t(measure)].name;
  if (name.starts_with("deformation")) return {0, 2};
  if (name.starts_with("moment_ratio") || name == "inertia_ratio") return {1, 2};
  if (name.starts_with("mode_")) return {0, order_of_mode(name[5] - '0')};
  return {};
}

BranchCurve::BranchCurve(const SampledBranch& branch, const ReferenceStiffness& reference) : branch_(&branch) {
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

Eigen::VectorXd BranchCurve::numbers(const std::vector<double>& weights) const {
  return numbers_.transpose() * Eigen::Map<const Eigen::VectorXd>(weights.data(), std::ssize(weights));
}

Eigen::MatrixX2d BranchCurve::contour(const std::vector<double>& weights) const {
  Eigen::MatrixX2d sum = weights[0] * branch_->contour[0];
  for (std::size_t k = 1; k < weights.size(); ++k) sum += weights[k] * branch_->contour[k];
  return sum;
}

double BranchCurve::error(double s) const {
  const auto weights = lagrange_weights(s_, std::clamp(s, s_.front(), s_.back())).value;
  double squares = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) squares += std::pow(weights[k] * branch_->error[k], 2);
  return std::sqrt(squares);
}

double BranchCurve::log_ratio_without(int sample) const {
  std::vector<double> nodes, values;
  for (int k = 0; k < branch_->samples(); ++k) {
    if (k == sample) continue;
    nodes.push_back(s_[std::size_t(k)]);
    values.push_back(log_ratio(k));
  }
  const auto weights = lagrange_weights(nodes, s_[std::size_t(sample)]).value;
  return std::inner_product(weights.begin(), weights.end(), values.begin(), 0.0);
}

}  // namespace rheocyte
