#include "population/shared_spread.h"

#include <vector>

#include "numeric/dense_solve.h"
#include "population/statistics_laws.h"

namespace rheocyte {
namespace {

constexpr int means = 2, spreads = population_parameters - means;
using SpreadMatrix = Eigen::Matrix<double, spreads, spreads>;
using SpreadVector = Eigen::Matrix<double, spreads, 1>;

}  // namespace

SpreadsApart share_spread(std::span<RecordingLaw> recordings) {
  if (recordings.size() < 2) return {};
  SpreadMatrix precision = SpreadMatrix::Zero();
  SpreadVector weighed = SpreadVector::Zero();
  std::vector<SpreadMatrix> known;
  for (const auto& [parameters, covariance] : recordings) {
    known.push_back(dense_inverse(covariance.bottomRightCorner<spreads, spreads>()));
    precision += known.back();
    weighed += known.back() * parameters.tail<spreads>();
  }
  const SpreadMatrix variance = dense_inverse(precision);
  const SpreadVector shared = variance * weighed;
  SpreadsApart apart{0, spreads * (double(recordings.size()) - 1), no_value};
  for (std::size_t j = 0; j < recordings.size(); ++j) {
    auto& [parameters, covariance] = recordings[j];
    const SpreadVector off = shared - parameters.tail<spreads>();
    apart.chi_squared += off.dot(known[j] * off);
    // The means' errors go with those of the spreads.
    const Eigen::Matrix<double, means, spreads> slope = covariance.topRightCorner<means, spreads>() * known[j];
    const Eigen::Matrix<double, means, means> alone =
        covariance.topLeftCorner<means, means>() - slope * covariance.bottomLeftCorner<spreads, means>();
    parameters.head<means>() += slope * off;
    parameters.tail<spreads>() = shared;
    covariance.bottomRightCorner<spreads, spreads>() = variance;
    covariance.topRightCorner<means, spreads>() = slope * variance;
    covariance.bottomLeftCorner<spreads, means>() = variance * slope.transpose();
    covariance.topLeftCorner<means, means>() = alone + slope * variance * slope.transpose();
  }
  apart.p = chi_squared_above(apart.freedom, apart.chi_squared);
  return apart;
}

}  // namespace rheocyte
