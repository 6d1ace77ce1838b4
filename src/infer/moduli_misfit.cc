#include "infer/moduli_misfit.h"

#include <algorithm>
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
                           const AxialTension& tension, TensionIs tension_is)
    : table_(table),
      shape_(std::move(shape)),
      features_(features),
      tension_(tension),
      follows_tension_(table.is_elongated() && tension_is == TensionIs::known) {
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

void ModuliMisfit::set_free(std::vector<int> free, const CellCoordinates& cell) {
  free_ = std::move(free);
  cell_ = cell;
  if (table_.is_elongated()) last_ = {cell, table_.at(cell)};
  if (follows_tension_) std::erase(free_, x_axial);
}

Eigen::VectorXd ModuliMisfit::parameters() const {
  Eigen::VectorXd parameters(free_.size());
  for (std::size_t i = 0; i < free_.size(); ++i) parameters(Eigen::Index(i)) = cell_(free_[i]);
  if (table_.is_elongated()) parameters(progress_parameter()) = last_.state.value(log_stiffness_row);
  return parameters;
}

ModuliMisfit::Place ModuliMisfit::place(const Eigen::VectorXd& parameters) const {
  Place place{cell_, {}, Eigen::MatrixXd::Zero(coordinate_count, parameters.size())};
  for (std::size_t i = 0; i < free_.size(); ++i) {
    place.by_parameters(free_[i], Eigen::Index(i)) = 1;
    place.cell(free_[i]) = parameters(Eigen::Index(i));
  }
  if (!table_.is_elongated()) {
    place.state = table_.at(place.cell);
    return place;
  }
  const Eigen::Index progress = progress_parameter();
  const double log_stiffness = parameters(progress);
  if (follows_tension_) {
    place.cell(x_axial) = 1e-3 * tension_.value_Pa * std::exp(-log_stiffness);
    place.by_parameters(x_axial, progress) = -place.cell(x_axial);
  }
  place.state = meet_stiffness(log_stiffness, place.cell);
  // d ln S = gradient . d cell, solved for the progress.
  const Eigen::RowVectorXd gradient = place.state.gradient.row(log_stiffness_row);
  place.by_parameters(x_progress, progress) = 0;
  Eigen::RowVectorXd left = -gradient * place.by_parameters;
  left(progress) += 1;
  place.by_parameters.row(x_progress) = left / gradient(x_progress);
  return place;
}

// By Newton's method: the stiffness falls nearly in proportion to one over the progress. The last step changes the
// state to first order, which leaves the square of the tolerance.
CombinedState ModuliMisfit::meet_stiffness(double log_stiffness, CellCoordinates& cell) const {
  constexpr int most_steps = 20;
  constexpr double tolerance = 1e-5, flattest = -0.3;
  const auto step = [&](double value, double slope) { return (log_stiffness - value) / std::min(slope, flattest); };
  const auto from_last = last_.state.gradient.row(log_stiffness_row);
  cell(x_progress) = last_.cell(x_progress);
  cell(x_progress) +=
      step(last_.state.value(log_stiffness_row) + from_last.dot(cell - last_.cell), from_last(x_progress));
  CellLine line = table_.line(cell);
  for (int k = 0;; ++k) {
    const CellFunction found = line.log_stiffness(cell(x_progress));
    const double change = step(found.value, found.gradient(x_progress));
    if (std::abs(change) < tolerance || k == most_steps) {
      CombinedState state = line.at(cell(x_progress));
      cell(x_progress) += change;
      state.value += change * state.gradient.col(x_progress);
      last_ = {cell, state};
      return state;
    }
    cell(x_progress) += change;
  }
}

Eigen::VectorXd ModuliMisfit::residuals(const Eigen::VectorXd& parameters, Eigen::MatrixXd* slopes) const {
  const Place at = place(parameters);
  Jacobian all;
  Eigen::VectorXd residuals = evaluate(at.cell, at.state, all);
  if (slopes) *slopes = all * at.by_parameters;
  return residuals;
}

Eigen::VectorXd ModuliMisfit::evaluate(const CellCoordinates& cell, const CombinedState& state,
                                       Jacobian& jacobian) const {
  const auto n = Eigen::Index(features_.size());
  const CellBox& box = table_.box();
  const CellCoordinates held = cell.cwiseMax(box.least).cwiseMin(box.greatest), beyond = cell - held;
  Eigen::VectorXd residual = Eigen::VectorXd::Zero(n + coordinate_count + 1);
  jacobian = Jacobian::Zero(residual.size(), coordinate_count);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto [value, gradient] = feature(features_[std::size_t(i)], cell, state);
    residual(i) = value - measured_(i);
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
  const double stiffness_Pa = 1e3 * std::exp(state.value(log_stiffness_row));
  const Eigen::Index last = n + coordinate_count;
  residual(last) = (cell(x_axial) * stiffness_Pa - tension_.value_Pa) / tension_.error_Pa;
  jacobian.row(last) =
      stiffness_Pa / tension_.error_Pa * (CellCoordinates::Unit(x_axial) + cell(x_axial) * by_cell).transpose();
  return residual;
}

Eigen::Matrix<double, coordinate_count, coordinate_count> ModuliMisfit::information(const CellCoordinates& cell) const {
  Jacobian all;
  evaluate(cell, table_.at(cell), all);
  const Jacobian features = all.topRows(Eigen::Index(features_.size())), tension = all.bottomRows(1);
  return features.transpose() * features + tension.transpose() * tension;
}

ModuliMisfit::Feature ModuliMisfit::feature(int number, const CellCoordinates& cell, const CombinedState& state) const {
  if (number == int(ShapeFeature::area_um2) && shape_.size_is_volume)
    return {std::log(4 * std::numbers::pi / 3) + 3 * cell(x_radius), 3 * CellCoordinates::Unit(x_radius)};
  return {state.value(row_of(number)), state.gradient.row(row_of(number)).transpose()};
}

}  // namespace rheocyte
