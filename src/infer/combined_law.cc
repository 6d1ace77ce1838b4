#include "infer/combined_law.h"

namespace rheocyte {

namespace {

/// Of the logarithm of a number that is normally distributed and hardly ever negative.
double mean_log(double mean, double variance) { return std::log(mean) - variance / (2 * mean * mean); }

/// ln of the effective modulus at the mean cell, and by each of the law's deviations from it that are independent: half
/// the differences and the second differences of cells on both sides.
struct LogEffective {
  double at_mean;
  Eigen::Vector4d slope = {}, bend = {};
};

LogEffective log_effective(const CombinedLaw& law, const CellsAtRest& cells) {
  const Eigen::Vector4d mean(law.mean(0), law.mean(1), law.mean(2), law.tension_ratio);
  const auto at = [&](const Eigen::Vector4d& x) {
    return x(1) + std::log(effective_modulus_over_stiffness<double>(cells, {x(0), x(1), x(2), x(3)}));
  };
  Eigen::Matrix4d root = Eigen::Matrix4d::Zero();
  root.topLeftCorner<combined_numbers, combined_numbers>() = law.root;
  root(3, 3) = law.ratio_spread;
  LogEffective log{.at_mean = at(mean)};
  for (int k = 0; k < 4; ++k) {
    const double above = at(mean + root.col(k)), below = at(mean - root.col(k));
    log.slope(k) = (above - below) / 2, log.bend(k) = above + below - 2 * log.at_mean;
  }
  return log;
}

}  // namespace

CombinedLogs log_means(const CombinedLaw& law, const CellsAtRest& cells) {
  const double fraction = law.mean(2), fraction_variance = std::pow(law.spread(2), 2);
  CombinedLogs logs;
  logs.stiffness = law.mean(1);
  const LogEffective effective = log_effective(law, cells);
  logs.effective = effective.at_mean + effective.bend.sum() / 2;
  logs.young = law.mean(1) + mean_log(1 - fraction, fraction_variance);
  logs.cortex = law.mean(1) + law.mean(0) + mean_log(fraction, fraction_variance);
  logs.tension = logs.cortex + mean_log(law.tension_ratio, std::pow(law.ratio_spread, 2));
  logs.axial = std::log(law.axial_tension);
  return logs;
}

CombinedVector slopes_of_mean(const CombinedVector& parameters, const CellsAtRest& cells, double CombinedLogs::*log) {
  constexpr double step = 1e-5;
  CombinedVector slopes;
  for (int a = 0; a < combined_parameters; ++a) {
    const CombinedVector change = step * CombinedVector::Unit(a);
    const auto at = [&](const CombinedVector& q) { return log_means(CombinedLaw::of(q), cells).*log; };
    slopes(a) = (at(parameters + change) - at(parameters - change)) / (2 * step);
  }
  return slopes;
}

CombinedLogs log_spreads(const CombinedLaw& law, const CellsAtRest& cells) {
  const double fraction = law.mean(2), ratio = law.tension_ratio;
  const auto spread = [&](const Eigen::RowVector3d& by_numbers) { return (by_numbers * law.root).norm(); };
  CombinedLogs logs;
  logs.stiffness = spread({0, 1, 0});
  logs.effective = log_effective(law, cells).slope.norm();
  logs.young = spread({0, 1, -1 / (1 - fraction)});
  logs.cortex = spread({1, 1, 1 / fraction});
  logs.tension = std::hypot(logs.cortex, law.ratio_spread / ratio);
  logs.axial = law.axial_spread / law.axial_tension;
  return logs;
}

}  // namespace rheocyte
