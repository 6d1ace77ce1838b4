#include "population/strangers.h"

#include <cmath>

#include "numeric/dense_solve.h"
#include "numeric/quantile.h"

namespace rheocyte {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Standard deviations of one number beyond which a normal distribution has one event of 20,000.
constexpr double far_away = 3.9;
constexpr int most_rounds = 5;

/// By how much the squared distance of an event far away exceeds that of the median one (Wilson and Hilferty 1931).
double stranger_over_median(double measures) {
  const double variance = 2 / (9 * measures), middle = 1 - variance;
  return std::pow((middle + far_away * std::sqrt(variance)) / middle, 3);
}

}  // namespace

Moments moments_of(const MatrixXd& events, const std::vector<bool>& leave_out) {
  VectorXd sum = VectorXd::Zero(events.cols());
  double count = 0;
  for (Eigen::Index i = 0; i < events.rows(); ++i) {
    if (leave_out[std::size_t(i)]) continue;
    sum += events.row(i).transpose();
    ++count;
  }
  Moments found{sum / count, MatrixXd::Zero(events.cols(), events.cols())};
  for (Eigen::Index i = 0; i < events.rows(); ++i) {
    if (leave_out[std::size_t(i)]) continue;
    const VectorXd off = events.row(i).transpose() - found.mean;
    found.covariance += off * off.transpose() / count;
  }
  return found;
}

std::vector<bool> strangers(const MatrixXd& events) {
  std::vector<bool> found(std::size_t(events.rows()), false);
  for (int round = 0; round < most_rounds; ++round) {
    const Moments moments = moments_of(events, found);
    const MatrixXd white = whitening(moments.covariance);
    if (white.size() == 0) return found;
    std::vector<double> distance(found.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      distance[i] = (white * (events.row(Eigen::Index(i)).transpose() - moments.mean)).squaredNorm();
    const double limit = stranger_over_median(double(events.cols())) * quantile(distance, 0.5);
    for (std::size_t i = 0; i < found.size(); ++i) found[i] = distance[i] > limit;
  }
  return found;
}

}  // namespace rheocyte
