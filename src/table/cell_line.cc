// States of combined cells: sums of what the branches around them have at their progress.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "numeric/hermite.h"
#include "table/combined_interpolation.h"

namespace rheocyte {

// Beyond its ends straight on.
template <int rows>
std::pair<Eigen::Matrix<double, rows, 1>, Eigen::Matrix<double, rows, 1>> CombinedInterpolation::along(
    const Curve& branch, double progress) {
  const auto first = [](const Row& row) { return row.head<rows>(); };
  if (progress < branch.place.front() || progress > branch.place.back()) {
    const auto end = progress > branch.place.front() ? branch.place.size() - 1 : 0;
    const auto& [value, slope] = branch.samples[end];
    return {first(value) + (progress - branch.place[end]) * first(slope), first(slope)};
  }
  const auto k = std::size_t(interval_of(branch.place, progress));
  const double h = branch.place[k + 1] - branch.place[k], t = (progress - branch.place[k]) / h;
  const auto &a = branch.samples[k], &b = branch.samples[k + 1];
  const auto sum = [&](const HermiteWeights& w, double unit) {
    return unit * (w.first * first(a.value) + w.last * first(b.value)) +
           unit * h * (w.first_slope * first(a.slope) + w.last_slope * first(b.slope));
  };
  return {sum(hermite(t), 1), sum(hermite_slope(t), 1 / h)};
}

template <int rows>
CombinedInterpolation::Sum<rows> CombinedInterpolation::sum_at(double progress, const CurveWeights& weights) {
  Sum<rows> sum;
  for (const auto& [curve, weight] : weights.all) {
    const auto [value, slope] = along<rows>(*curve, progress);
    sum.value += weight.value * value;
    for (int k = 0; k < coordinate_count; ++k)  // most do not depend on most coordinates
      if (weight.gradient(k) != 0) sum.gradient.col(k) += weight.gradient(k) * value;
    sum.gradient.col(x_progress) += weight.value * slope;
  }
  return sum;
}

std::vector<BranchWeight> CombinedInterpolation::weights(const CellCoordinates& cell) const {
  if (!is_inside(cell)) return {};
  std::vector<BranchWeight> all;
  const double progress = cell(x_progress);
  for (const auto& [curve, weight] : curve_weights(cell).all) {
    const double log_stiffness = along<1>(*curve, progress).first(log_stiffness_row);
    all.push_back({curve->branch, weight.value, std::exp(log_stiffness - growth(log_stiffness_row) * progress)});
  }
  return all;
}

CellLine CombinedInterpolation::line(const CellCoordinates& cell) const { return {*this, cell}; }

CombinedState CombinedInterpolation::at(const CellCoordinates& cell) const { return line(cell).at(cell(x_progress)); }

void CellLine::go_to(double progress) {
  const bool has_weights = std::max(cell_(x_progress), progress) <= weights_.last_progress;
  cell_(x_progress) = progress;
  if (!has_weights) weights_ = table_.curve_weights(cell_);
}

// Back from what hardly varies to what is asked for, as below.
CellFunction CellLine::log_stiffness(double progress) {
  go_to(progress);
  const auto sum = CombinedInterpolation::sum_at<1>(progress, weights_);
  const double growth = table_.growth(log_stiffness_row);
  return {sum.value(log_stiffness_row) - growth * progress,
          sum.gradient.row(log_stiffness_row).transpose() - growth * CellCoordinates::Unit(x_progress)};
}

CombinedState CellLine::at(double progress) {
  go_to(progress);
  const auto sum = CombinedInterpolation::sum_at<CombinedInterpolation::padded_rows>(progress, weights_);
  CombinedState state{sum.value.head<row_count>(), sum.gradient.topRows<row_count>(), table_.is_inside(cell_)};
  double known_power = 0, unit = 1;
  for (int row = log_area_row; row < row_count; ++row) {
    const double power = table_.growth(row);
    if (power != known_power) unit = std::exp(power * progress);
    known_power = power;
    state.value(row) *= unit;
    state.gradient.row(row) *= unit;
    state.gradient(row, x_progress) += power * state.value(row);
  }
  state.value(log_stiffness_row) -= table_.growth(log_stiffness_row) * progress;
  state.gradient(log_stiffness_row, x_progress) -= table_.growth(log_stiffness_row);
  state.value(log_area_row) += std::log(std::numbers::pi) + 2 * cell_(x_radius);
  state.gradient(log_area_row, x_radius) += 2;
  state.value(moment_ratio_row) += 1;
  return state;
}

}  // namespace rheocyte
