// The least sum of squares of functions of some numbers.
#pragma once
#include <Eigen/Core>
#include <functional>

namespace rheocyte {

/// Residuals at x and, where they are requested, their slopes by x (residuals x numbers).
using Residuals = std::function<Eigen::VectorXd(const Eigen::VectorXd& x, Eigen::MatrixXd* slopes)>;

/// Moves x to where |residuals|^2 is least on the way down from it, and returns that: the method of Levenberg and
/// Marquardt, damped as Nielsen (1999) has it. The end is where a step gains less than 1e-9. Where residuals are not
/// finite x stays.
double minimise_squares(const Residuals& residuals, Eigen::VectorXd& x);

}  // namespace rheocyte
