// States of combined cells: sums of what the branches around them have at their progress.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "numeric/hermite.h"
#include "table/combined_interpolation.h"

namespace rheocyte {

/// Where a progress lies on a curve: between two samples, or beyond its ends, where it goes straight on.
class CombinedInterpolation::OnCurve {
 public:
  OnCurve(const Curve& curve, double progress) {
    const auto& place = curve.place;
    if (progress < place.front() || progress > place.back()) {
      const auto end = progress > place.front() ? place.size() - 1 : 0;
      before_ = &curve.samples[end];
      place_ = progress - place[end];
      return;
    }
    const auto k = std::size_t(interval_of(place, progress));
    before_ = &curve.samples[k];
    after_ = before_ + 1;
    distance_ = place[k + 1] - place[k];
    place_ = (progress - place[k]) / distance_;
  }

  /// Of the first rows; the slope over ln of the progress.
  template <int rows>
  Eigen::Matrix<double, rows, 1> value() const {
    const auto& [value, slope] = *before_;
    if (after_ == nullptr) return value.template head<rows>() + place_ * slope.template head<rows>();
    return sum<rows>(hermite(place_), 1);
  }
  template <int rows>
  Eigen::Matrix<double, rows, 1> slope() const {
    if (after_ == nullptr) return before_->slope.template head<rows>();
    return sum<rows>(hermite_slope(place_), 1 / distance_);
  }

 private:
  template <int rows>
  Eigen::Matrix<double, rows, 1> sum(const HermiteWeights& w, double unit) const {
    const auto first = [](const Row& row) { return row.head<rows>(); };
    return unit * (w.first * first(before_->value) + w.last * first(after_->value)) +
           unit * distance_ * (w.first_slope * first(before_->slope) + w.last_slope * first(after_->slope));
  }

  const Curve::Sample *before_ = nullptr, *after_ = nullptr;
  double distance_ = 0, place_ = 0;
};

template <int rows>
CombinedInterpolation::Sum<rows> CombinedInterpolation::sum_at(double progress, const CurveWeights& weights) {
  Sum<rows> sum;
  for (const auto& [curve, weight] : weights.all) {
    const OnCurve here(*curve, progress);
    const Eigen::Matrix<double, rows, 1> value = here.value<rows>();
    sum.value += weight.value * value;
    for (int k = 0; k < coordinate_count; ++k)  // most do not depend on most coordinates
      if (weight.gradient(k) != 0) sum.gradient.col(k) += weight.gradient(k) * value;
    sum.gradient.col(x_progress) += weight.value * here.slope<rows>();
  }
  return sum;
}

std::vector<BranchWeight> CombinedInterpolation::weights(const CellCoordinates& cell) const {
  if (!is_inside(cell)) return {};
  std::vector<BranchWeight> all;
  const double progress = cell(x_progress);
  for (const auto& [curve, weight] : curve_weights(cell).all) {
    const double log_stiffness = OnCurve(*curve, progress).value<1>()(log_stiffness_row);
    all.push_back({curve->branch, weight.value, std::exp(log_stiffness - growth(log_stiffness_row) * progress)});
  }
  return all;
}

Eigen::Matrix<double, row_count, 1> CombinedInterpolation::values_at(const CellCoordinates& cell) const {
  const double progress = cell(x_progress);
  Row sum = Row::Zero();
  for (const auto& [curve, weight] : curve_weights(cell).all)
    sum += weight.value * OnCurve(*curve, progress).value<padded_rows>();
  double known_power = 0, unit = 1;
  for (int row = log_area_row; row < row_count; ++row) {
    if (growth(row) != known_power) unit = std::exp(growth(row) * progress);
    known_power = growth(row);
    sum(row) *= unit;
  }
  sum(log_stiffness_row) -= growth(log_stiffness_row) * progress;
  sum(log_area_row) += std::log(std::numbers::pi) + 2 * cell(x_radius);
  sum(moment_ratio_row) += 1;
  return sum.head<row_count>();
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
