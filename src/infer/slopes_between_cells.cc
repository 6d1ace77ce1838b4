#include "infer/slopes_between_cells.h"

#include <Eigen/Dense>
#include <cmath>

namespace rheocyte {

namespace {

constexpr int mode_2_row = first_mode_row;
constexpr double far_off = 4;  // standard deviations
constexpr std::size_t min_cells_for_slopes = 20;

/// One mode over the second one; its slope and the standard error.
struct Regression {
  double slope, error;
};

Regression regression(const std::vector<CellModes>& cells, std::size_t mode) {
  const auto n = Eigen::Index(cells.size());
  Eigen::MatrixX3d design(n, 3);
  Eigen::VectorXd value(n), weight = Eigen::VectorXd::Ones(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const CellModes& cell = cells[std::size_t(i)];
    design.row(i) << 1, cell.modes[0], cell.log_area;
    value(i) = cell.modes[mode];
  }
  Regression found{no_value, no_value};
  constexpr int rounds = 4;
  for (int round = 0; round < rounds; ++round) {
    const Eigen::Matrix3d inverse = (design.transpose() * weight.asDiagonal() * design).inverse();
    const Eigen::Vector3d best = inverse * (design.transpose() * weight.asDiagonal() * value);
    const Eigen::VectorXd off = value - design * best;
    const double variance = weight.dot(off.cwiseAbs2()) / (weight.sum() - 3);
    found = {best(1), std::sqrt(variance * inverse(1, 1))};
    weight = (off.array().abs() < far_off * std::sqrt(variance)).cast<double>();
  }
  return found;
}

/// d(c_3, c_4, c_5)/d(c_2) along a direction in which the area and one more quantity stay.
ModeSlopes slopes_along(const CombinedState& state, const CellCoordinates& held) {
  constexpr std::array<int, 3> moved{x_radius, x_progress, x_axial};
  Eigen::Vector3d area, other;
  for (int i = 0; i < 3; ++i) {
    area(i) = state.gradient(log_area_row, moved[std::size_t(i)]);
    other(i) = held(moved[std::size_t(i)]);
  }
  const Eigen::Vector3d direction = area.cross(other);
  const auto along = [&](int row) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += state.gradient(row, moved[std::size_t(i)]) * direction(i);
    return sum;
  };
  ModeSlopes slopes{};
  for (int k = 0; k < slope_count; ++k) slopes[std::size_t(k)] = along(mode_2_row + 1 + k) / along(mode_2_row);
  return slopes;
}

}  // namespace

CellModes cell_modes(const ShapeVector& shape) {
  CellModes cell{shape(int(ShapeFeature::area_um2)), {}};
  for (int k = 0; k <= slope_count; ++k) cell.modes[std::size_t(k)] = shape(int(ShapeFeature::first_mode) + k);
  return cell;
}

SlopesBetweenCells slopes_between(const std::vector<CellModes>& cells) {
  SlopesBetweenCells slopes;
  slopes.cells = cells.size();
  if (cells.size() < min_cells_for_slopes) return slopes;
  for (std::size_t k = 0; k < slope_count; ++k) {
    const Regression found = regression(cells, k + 1);
    slopes.value[k] = found.slope;
    slopes.error[k] = found.error;
  }
  return slopes;
}

PredictedSlopes predicted_slopes(const CombinedInterpolation& table, const CellCoordinates& cell) {
  const CombinedState state = table.at(cell);
  const CellCoordinates stiffness = state.gradient.row(log_stiffness_row).transpose();
  // T = axial ratio times stiffness.
  const CellCoordinates tension = CellCoordinates::Unit(x_axial) + cell(x_axial) * stiffness;
  return {slopes_along(state, tension), slopes_along(state, stiffness)};
}

}  // namespace rheocyte
