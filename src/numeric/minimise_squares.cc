#include "numeric/minimise_squares.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace rheocyte {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_steps = 100;
constexpr double first_damping = 1e-4, least_damped = 1e-6, greatest_damped = 1e32;
/// At the end: of the slope, of a step relative to x, of the gain, and of the squares themselves.
constexpr double least_slope = 1e-10, least_step = 1e-8, least_gain = 1e-9,
                 least_sum = 2 * std::numeric_limits<double>::epsilon();

/// The squares about a place as those of linear residuals: squares - 2 downhill . step + step . matrix . step.
struct Paraboloid {
  MatrixXd matrix;
  VectorXd downhill;
  double squares;

  bool is_least() const { return downhill.lpNorm<Eigen::Infinity>() < least_slope || squares < least_sum; }
  VectorXd step(double damping) const {
    MatrixXd damped = matrix;
    damped.diagonal() += damping * matrix.diagonal().cwiseMax(least_damped).cwiseMin(greatest_damped);
    return Eigen::LDLT<MatrixXd>(damped).solve(downhill);
  }
  double gain(const VectorXd& step) const { return step.dot(2 * downhill - matrix * step); }
};

}  // namespace

double minimise_squares(const Residuals& residuals, VectorXd& x) {
  VectorXd unit;  // of each number: the steeper the residuals at first, the smaller
  const auto about = [&] {
    MatrixXd slopes;
    const VectorXd there = residuals(x, &slopes);
    if (unit.size() == 0) unit = (1 + slopes.colwise().norm().transpose().array()).inverse();
    slopes = slopes * unit.asDiagonal();
    return Paraboloid{slopes.transpose() * slopes, -(slopes.transpose() * there), there.squaredNorm()};
  };
  Paraboloid here = about();
  double damping = first_damping, more = 2;
  for (int k = 1; k < most_steps && !here.is_least(); ++k) {
    const VectorXd step = here.step(damping), move = unit.cwiseProduct(step);
    if (move.norm() < least_step * (x.norm() + least_step)) break;
    const VectorXd next = x + move;
    const double squares = residuals(next, nullptr).squaredNorm(), gain = here.squares - squares,
                 fraction = gain / here.gain(step);
    const bool leads_on = fraction > 0, is_last = std::abs(gain) < least_gain;
    if (leads_on) x = next;
    if (leads_on && is_last) here.squares = squares;
    if (is_last) break;
    if (leads_on) {
      here = about();
      damping *= std::max(1.0 / 3, 1 - std::pow(2 * fraction - 1, 3));
      more = 2;
    } else {
      damping *= more;
      more *= 2;
    }
  }
  return here.squares;
}

}  // namespace rheocyte
