#include "infer/slopes_between_cells.h"

#include <array>
#include <cmath>

#include "numeric/dense_solve.h"

namespace rheocyte {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int mode_2_row = first_mode_row;
constexpr Eigen::Index log_area = 0, mode_2 = 1;  // of CellModes
constexpr double far_off = 4;                     // standard deviations
constexpr int rounds = 4;
constexpr double error_of_noise = 0.1;
/// Of the scatter of the second mode that must be the cells' own.
constexpr double least_part = 0.5;
constexpr double errors_allowed = 3, slope_allowed = 0.1;

/// One mode over the second one; its slope and the standard error.
struct Regression {
  double slope = no_value, error = no_value;
};

/// Lines of a mode over the second one and ln(area) of cells with errors in all of them.
class NoisyLine {
 public:
  NoisyLine(const std::vector<CellModes>& cells, const ModeNoise& noise, Eigen::Index mode)
      : design_(Eigen::Index(cells.size()), 3), value_(design_.rows()) {
    for (Eigen::Index i = 0; i < design_.rows(); ++i) {
      const CellModes& cell = cells[std::size_t(i)];
      design_.row(i) << 1, cell(mode_2), cell(log_area);
      value_(i) = cell(mode);
    }
    const std::array<Eigen::Index, 2> known{mode_2, log_area};
    noise_of_known_.bottomRightCorner<2, 2>() = noise(known, known);
    noise_of_both_.tail<2>() = noise(known, mode);
  }

  /// What a tenth of the noise is worth counts as an error of the slope.
  Regression found() const {
    const Regression corrected = without(1), plain = without(0);
    return {corrected.slope, std::hypot(corrected.error, error_of_noise * (corrected.slope - plain.slope))};
  }

 private:
  /// Less so much of the noise.
  Regression without(double part) const {
    const MatrixXd known = part * noise_of_known_;
    const VectorXd both = part * noise_of_both_;
    VectorXd weight = VectorXd::Ones(value_.size());
    Regression found;
    for (int round = 0; round < rounds; ++round) {
      const double cells = weight.sum();
      const MatrixXd weighed = weight.asDiagonal() * design_, seen = design_.transpose() * weighed,
                     inverse = dense_inverse(seen - cells * known);
      if (!(1 / inverse(1, 1) > least_part / dense_inverse(seen)(1, 1))) return {};
      const VectorXd best = inverse * (weighed.transpose() * value_ - cells * both), off = value_ - design_ * best;
      MatrixXd scores = off.asDiagonal() * design_;
      scores.rowwise() -= (both - known * best).transpose();
      const MatrixXd scatter = scores.transpose() * MatrixXd(weight.asDiagonal() * scores);
      found = {best(1), std::sqrt(cells / (cells - 3) * (inverse * scatter * inverse)(1, 1))};
      const double deviation = std::sqrt(weight.dot(off.cwiseAbs2()) / (cells - 3));
      weight = (off.array().abs() < far_off * deviation).cast<double>();
    }
    return found;
  }

  MatrixXd design_;
  VectorXd value_;
  MatrixXd noise_of_known_ = MatrixXd::Zero(3, 3);
  VectorXd noise_of_both_ = VectorXd::Zero(3);
};

/// The features of CellModes.
constexpr std::array<int, 2 + slope_count> told{int(ShapeFeature::area_um2), feature_of_mode(2), feature_of_mode(3),
                                                feature_of_mode(4), feature_of_mode(5)};

/// d(c_3, c_4, c_5)/d(c_2) along the direction in which none of these changes.
ModeSlopes slopes_along(const CombinedState& state, std::initializer_list<CellCoordinates> held) {
  Eigen::Matrix<double, coordinate_count - 1, coordinate_count> rows;
  Eigen::Index row = 0;
  for (const CellCoordinates& gradient : held) rows.row(row++) = gradient.transpose();
  const CellCoordinates direction = null_vector(rows);
  ModeSlopes slopes{};
  for (int k = 0; k < slope_count; ++k)
    slopes[std::size_t(k)] =
        state.gradient.row(mode_2_row + 1 + k).dot(direction) / state.gradient.row(mode_2_row).dot(direction);
  return slopes;
}

}  // namespace

CellModes cell_modes(const ShapeVector& shape) { return shape(told); }

ModeNoise mode_noise(const ShapeErrors& errors) { return errors.covariance(told, told); }

SlopesBetweenCells slopes_between(const std::vector<CellModes>& cells, const ModeNoise& noise) {
  SlopesBetweenCells slopes;
  slopes.cells = cells.size();
  if (!slopes.are_enough()) return slopes;
  for (std::size_t k = 0; k < slope_count; ++k) {
    const Regression found = NoisyLine(cells, noise, mode_2 + 1 + Eigen::Index(k)).found();
    slopes.value[k] = found.slope;
    slopes.error[k] = found.error;
  }
  return slopes;
}

PredictedSlopes predicted_slopes(const CombinedInterpolation& table, const CellCoordinates& cell) {
  const CombinedState state = table.at(cell);
  const CellCoordinates area = state.gradient.row(log_area_row), stiffness = state.gradient.row(log_stiffness_row);
  const CellCoordinates fraction = CellCoordinates::Unit(x_fraction), ratio = CellCoordinates::Unit(x_ratio);
  // T = axial ratio times stiffness.
  const CellCoordinates tension = CellCoordinates::Unit(x_axial) + cell(x_axial) * stiffness;
  return {.by_stiffness = slopes_along(state, {area, fraction, ratio, tension}),
          .by_fraction = slopes_along(state, {area, stiffness, ratio, tension}),
          .by_ratio = slopes_along(state, {area, stiffness, fraction, tension}),
          .by_axial_tension = slopes_along(state, {area, stiffness, fraction, ratio})};
}

bool are_of_one_tension(const SlopesBetweenCells& measured, const PredictedSlopes& predicted) {
  constexpr int parts = 50;  // fine enough for the 0.1
  const auto is_met = [&](double stiffness, double fraction, double ratio) {
    bool met = true;
    for (std::size_t k = 0; k < slope_count; ++k) {
      const double mean =
          stiffness * predicted.by_stiffness[k] + fraction * predicted.by_fraction[k] + ratio * predicted.by_ratio[k];
      met = met && std::abs(measured.value[k] - mean) < errors_allowed * measured.error[k] + slope_allowed;
    }
    return met;
  };
  for (int i = 0; i <= parts; ++i)
    for (int j = 0; i + j <= parts; ++j)
      if (is_met(double(parts - i - j) / parts, double(i) / parts, double(j) / parts)) return true;
  return false;
}

}  // namespace rheocyte
