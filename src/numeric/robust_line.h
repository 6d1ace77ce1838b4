// A straight line through scattered points of which some do not belong to the others.
#pragma once
#include <cstddef>
#include <span>

#include "numeric/no_value.h"

namespace rheocyte {

/// A number and its standard error; NaN where there is none.
struct Estimate {
  double value = no_value, error = no_value;
};

/// y = middle + slope (x - middle_x).
struct RobustLine {
  Estimate slope, middle;
  double middle_x = no_value;  ///< where the errors of slope and height do not depend on each other
  std::size_t points = 0;      ///< pairs of finite numbers
};

/// Tukey's bisquare estimator (c = 4.685 robust standard deviations), from Huber's: points far from the line do not
/// count, 95 % of the precision of least squares otherwise. Standard errors are Huber's (Robust Statistics, 1981, sec.
/// 7.6). Pairs with a number that is not finite are left out; NaN of fewer than 3 pairs, or where x is constant.
RobustLine robust_line(std::span<const double> x, std::span<const double> y);

}  // namespace rheocyte
