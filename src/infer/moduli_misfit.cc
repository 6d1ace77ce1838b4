#include "infer/moduli_misfit.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "numeric/dense_solve.h"

namespace rheocyte {

namespace {

/// Beyond the table the features go straight on, and each of so many widths counts as one standard error.
constexpr double fence_widths = 0.2;

}  // namespace

CellCoordinates widths(const CellBox& box) {
  const CellCoordinates range = box.greatest - box.least;
  return (range.array() > 0).select(range, CellCoordinates::Ones());
}

ModuliMisfit::ModuliMisfit(const CombinedInterpolation& table, MeasuredShape shape, std::span<const int> features,
                           const AxialTension& tension)
    : table_(table), shape_(std::move(shape)), features_(features), tension_(tension) {
  const auto n = Eigen::Index(features.size());
  measured_.resize(n);
  Eigen::MatrixXd covariance(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const int f = features[std::size_t(i)];
    measured_(i) = shape_.features(f) - shape_.errors.bias(f);
    for (Eigen::Index k = 0; k < n; ++k) covariance(i, k) = shape_.errors.covariance(f, features[std::size_t(k)]);
  }
  whitening_ = whitening(covariance);
}

bool ModuliMisfit::operator()(const double* parameters, double* residuals, double* jacobian) const {
  CellCoordinates cell = cell_;
  for (std::size_t i = 0; i < free_.size(); ++i) cell(free_[i]) = parameters[i];
  Jacobian all;
  Eigen::Map<Eigen::VectorXd>(residuals, NumResiduals()) = evaluate(cell, all);
  for (std::size_t i = 0; jacobian && i < free_.size(); ++i)
    Eigen::Map<Eigen::VectorXd>(jacobian + i * std::size_t(NumResiduals()), NumResiduals()) = all.col(free_[i]);
  return true;
}

Eigen::VectorXd ModuliMisfit::evaluate(const CellCoordinates& cell, Jacobian& jacobian) const {
  const auto n = Eigen::Index(features_.size());
  const CellBox& box = table_.box();
  const CellCoordinates held = cell.cwiseMax(box.least).cwiseMin(box.greatest), beyond = cell - held;
  const CombinedState state = table_.at(held);
  Eigen::VectorXd residual = Eigen::VectorXd::Zero(NumResiduals());
  jacobian = Jacobian::Zero(NumResiduals(), coordinate_count);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto [value, gradient] = feature(features_[std::size_t(i)], held, state);
    residual(i) = value + gradient.dot(beyond) - measured_(i);
    jacobian.row(i) = gradient.transpose();
  }
  residual.head(n) = whitening_ * residual.head(n);
  jacobian.topRows(n) = whitening_ * jacobian.topRows(n);
  const CellCoordinates fence = fence_widths * widths(box);
  for (int x = 0; x < coordinate_count; ++x) {
    residual(n + x) = beyond(x) / fence(x);
    if (beyond(x) != 0) jacobian(n + x, x) = 1 / fence(x);
  }
  if (!table_.is_elongated()) return residual;
  const CellCoordinates by_cell = state.gradient.row(log_stiffness_row).transpose();
  const double stiffness_Pa = 1e3 * std::exp(state.value(log_stiffness_row) + by_cell.dot(beyond));
  const Eigen::Index last = n + coordinate_count;
  residual(last) = (cell(x_axial) * stiffness_Pa - tension_.value_Pa) / tension_.error_Pa;
  jacobian.row(last) =
      stiffness_Pa / tension_.error_Pa * (CellCoordinates::Unit(x_axial) + cell(x_axial) * by_cell).transpose();
  return residual;
}

Eigen::Matrix<double, coordinate_count, coordinate_count> ModuliMisfit::information(const CellCoordinates& cell) const {
  Jacobian all;
  evaluate(cell, all);
  const Jacobian features = all.topRows(Eigen::Index(features_.size())), tension = all.bottomRows(1);
  return features.transpose() * features + tension.transpose() * tension;
}

ModuliMisfit::Feature ModuliMisfit::feature(int number, const CellCoordinates& cell, const CombinedState& state) const {
  if (number == int(ShapeFeature::area_um2) && shape_.size_is_volume)
    return {std::log(4 * std::numbers::pi / 3) + 3 * cell(x_radius), 3 * CellCoordinates::Unit(x_radius)};
  return {state.value(row_of(number)), state.gradient.row(row_of(number)).transpose()};
}

}  // namespace rheocyte
