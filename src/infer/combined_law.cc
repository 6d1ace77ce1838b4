#include "infer/combined_law.h"

namespace rheocyte {

namespace {

/// Of the logarithm of a number that is normally distributed and hardly ever negative.
double mean_log(double mean, double variance) { return std::log(mean) - variance / (2 * mean * mean); }

}  // namespace

CombinedLogs log_means(const CombinedLaw& law) {
  const double fraction = law.mean(2), fraction_variance = std::pow(law.spread(2), 2);
  CombinedLogs logs;
  logs.stiffness = law.mean(1);
  logs.young = law.mean(1) + mean_log(1 - fraction, fraction_variance);
  logs.cortex = law.mean(1) + law.mean(0) + mean_log(fraction, fraction_variance);
  logs.tension = logs.cortex + mean_log(law.tension_ratio, std::pow(law.ratio_spread, 2));
  logs.axial = std::log(law.axial_tension);
  return logs;
}

CombinedVector slopes_of_mean(const CombinedVector& parameters, double CombinedLogs::*log) {
  constexpr double step = 1e-5;
  CombinedVector slopes;
  for (int a = 0; a < combined_parameters; ++a) {
    const CombinedVector change = step * CombinedVector::Unit(a);
    slopes(a) =
        (log_means(CombinedLaw::of(parameters + change)).*log - log_means(CombinedLaw::of(parameters - change)).*log) /
        (2 * step);
  }
  return slopes;
}

CombinedLogs log_spreads(const CombinedLaw& law) {
  const double fraction = law.mean(2), ratio = law.tension_ratio;
  const auto spread = [&](const Eigen::RowVector3d& by_numbers) { return (by_numbers * law.root).norm(); };
  CombinedLogs logs;
  logs.stiffness = spread({0, 1, 0});
  logs.young = spread({0, 1, -1 / (1 - fraction)});
  logs.cortex = spread({1, 1, 1 / fraction});
  logs.tension = std::hypot(logs.cortex, law.ratio_spread / ratio);
  logs.axial = law.axial_spread / law.axial_tension;
  return logs;
}

}  // namespace rheocyte
